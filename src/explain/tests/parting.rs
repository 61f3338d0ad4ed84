//! What is said of a pixel that differs from that of a reference.

use super::*;

/// What parts the middle pixel of a scene from that of another.
fn parted(text: &str, reference: &str, how: How) -> Option<String> {
    let [a, b] = [text, reference].map(|text| explained(Language::Ray, text, [20, 15], how));
    let subjects = [subject(&a.1, &a.2), subject(&b.1, &b.2)];
    parting([&a.0, &b.0], [&subjects[0], &subjects[1]])
}

#[test]
fn the_ray_or_term_that_differs_most_is_named() {
    let ball = format!("sphere 0 0 0 1 {GREY}");
    let screen = format!("sphere 1.5 1.5 3.5 .3 {GREY}");
    let mirror = |kr: &str| format!("sphere 0 0 0 1 .1 .1 .1 .2 .2 .2 0 0 0 1 {kr} 0 1");
    let around = format!("sphere 0 0 0 20 {GREY}");
    let lit = |ambient: &str, light: &str, first: &str| ray(ambient, light, &[first, &around]);
    let plain = lit(".1 .1 .1", LAMP, &ball);
    let two = plain.replacen("\n1 ", "\n2 0 2 9 1 1 1\n", 1);
    for (text, reference, said) in [
        (plain.clone(), plain.clone(), None),
        (
            ray(".1 .1 .1", LAMP, &[&ball, &around, &screen]),
            plain.clone(),
            Some(
                "in shadow of object 3 (sphere, line 6): the reference is lit by light 1 (line 2)",
            ),
        ),
        (
            plain.clone(),
            ray(".1 .1 .1", LAMP, &[&ball, &around, &screen]),
            Some(
                "lit by light 1 (line 2): in the reference in shadow of object 3 (sphere, line 6)",
            ),
        ),
        (
            plain.clone(),
            two.clone(),
            Some("a light is missing: the reference is lit by its light 2 (line 3)"),
        ),
        (
            two,
            plain.clone(),
            Some("lit by light 2 (line 3), which the reference does not have"),
        ),
        (
            lit(".1 .1 .1", "3 3 6 .5 .5 .5", &ball),
            plain.clone(),
            Some("light 1 (line 2) sends 0.5, in the reference 1"),
        ),
        (
            lit(".4 .1 .1", LAMP, &ball),
            plain.clone(),
            Some("ambient light adds 0.08 0.02 0.02, in the reference 0.02"),
        ),
        (
            lit(".1 .1 .1", "0 0 -9 1 1 1", &ball),
            plain.clone(),
            Some(
                "light 1 (line 2) adds nothing (faces away): the reference is lit by light 1 (line 2)",
            ),
        ),
        (
            lit(".1 .1 .1", LAMP, &mirror(".8")),
            lit(".1 .1 .1", LAMP, &mirror("0")),
            Some("a mirrored ray goes on from here, but not in the reference"),
        ),
        (
            lit(".1 .1 .1", LAMP, &mirror("0")),
            lit(".1 .1 .1", LAMP, &mirror(".8")),
            Some("no mirrored ray goes on from here: one does in the reference"),
        ),
        (
            lit(".1 .1 .1", LAMP, &mirror(".4")),
            lit(".1 .1 .1", LAMP, &mirror(".8")),
            Some("the mirrored ray counts 0.4, in the reference 0.8"),
        ),
        (
            ray(".1 .1 .1", LAMP, &[&around]),
            plain.clone(),
            Some(
                "shows object 1 (sphere, line 4) at (0.3033, -0.3033, -20): the reference shows object 1 \
                 (sphere, line 4) at (0.04856, -0.04856, 0.9976)",
            ),
        ),
        (
            plain.replace("eye 0 0 5", "eye 0 0 6"),
            plain.clone(),
            Some("seen from (0, 0, 6), in the reference (0, 0, 5)"),
        ),
        (
            plain.replace("target 0 0 0", "target 0 1 0"),
            plain.clone(),
            Some("seen in another direction than in the reference: the cameras differ"),
        ),
    ] {
        assert_eq!(parted(&text, &reference, PLAIN).as_deref(), said, "{text}");
    }
    // Paths part as well.
    let dim = lit(".1 .1 .1", "3 3 6 .5 .5 .5", &ball);
    assert!(parted(&dim, &plain, PATH).is_some());
    assert_eq!(parted(&plain, &plain, PATH), None);
}
