//! Edits of one object among very many: of its colour and shape, and by another program;
//! of what is beside them; and changes of structure.

mod structure;

use std::path::Path;
use std::time::{Duration, Instant};

use crate::desk::{Desk, Drawn};
use crate::figures::{SECOND, each, first, times_row};
use crate::scenes;

/// A scene, the object that is edited, and the targets.
struct Case {
    name: &'static str,
    text: String,
    /// The position of the first sphere in the list.
    row: usize,
    target: &'static str,
    /// The time within which a picture settles.
    settled: Duration,
    from_disk: &'static str,
}

pub(crate) fn measure() {
    let spheres = scenes::random_spheres(1_000_000, 1);
    // Makes the first one large enough to be visible.
    let (head, rest) = spheres.split_once("sphere\n").expect("there are spheres");
    let (_, rest) = rest.split_once('\n').expect("its material follows");
    let million = format!("{head}sphere\n0 0 0 .7\n{rest}");
    for case in [
        Case {
            name: "66,431",
            text: scenes::sphereflake(5),
            row: 6,
            target: "p95 <= 50",
            settled: SECOND / 2,
            from_disk: "-",
        },
        Case {
            name: "1,000,000",
            text: million.clone(),
            row: 3,
            target: "p95 <= 250",
            settled: 2 * SECOND,
            from_disk: "p95 <= 500",
        },
    ] {
        edit(&case);
    }
    own_materials(&million);
}

/// Edits of one of a million materials.
fn own_materials(text: &str) {
    let mut objects = text.split("sphere\n");
    let mut own = objects.next().expect("the lights").to_owned();
    for (number, object) in objects.enumerate() {
        let (shape, rest) = object.split_once('\n').expect("its material follows");
        let (_, rest) = rest.split_once('\n').expect("of several lines");
        let object = format!("sphere\n{shape}\n.{number:06} .5 .5\n{rest}");
        own.push_str(&object);
    }
    let case = Case {
        name: "1,000,000 materials",
        text: own,
        row: 3,
        target: "p95 <= 250",
        settled: 2 * SECOND,
        from_disk: "-",
    };
    let (mut desk, begun) = open(&case);
    desk.record(begun + 8 * SECOND);
    desk.rest();
    desk.look();
    down(&mut desk, &["gg", "j"]);
    down(&mut desk, &vec!["j"; case.row]);
    down(&mut desk, &["e", "j", "j", "j"]);
    nudge(&mut desk, &case, "colour");
}

fn open(case: &Case) -> (Desk, Instant) {
    let text = case.text.replace("size 1280 720", "size 400 300");
    Desk::open_files(&[("scene.ray", &text)], &[], &[])
}

fn edit(case: &Case) {
    let name = case.name;
    let (mut desk, begun) = open(case);
    desk.record(begun + 8 * SECOND);
    desk.rest();
    let drawn = desk.look();
    let opened: Vec<_> = first(&drawn, begun, Drawn::is_picture)
        .into_iter()
        .collect();
    times_row(&format!("{name}: start to picture"), &opened, "-");
    let text = case.text.replace("size 1280 720", "size 400 300");
    save(&mut desk, case, &text);
    merge(&mut desk, case, &text);
    down(&mut desk, &["gg", "j"]);
    down(&mut desk, &vec!["j"; case.row]);
    structure::measure(&mut desk, name, case.target, case.settled);
    down(&mut desk, &["gg", "j"]);
    down(&mut desk, &vec!["j"; case.row]);
    down(&mut desk, &["e"]);
    // From the centre to the radius, and from there to the second colour.
    for (what, fields) in [("shape", 1), ("colour", 2)] {
        down(&mut desk, &vec!["j"; fields]);
        nudge(&mut desk, case, what);
    }
    // The last light is listed before the first sphere, the view at the top.
    down(&mut desk, &["\x1b", "k", "e"]);
    nudge(&mut desk, case, "light");
    down(&mut desk, &["\x1b", "gg", "e"]);
    nudge(&mut desk, case, "view");
}

/// Nudges a field back and forth.
fn nudge(desk: &mut Desk, case: &Case, what: &str) {
    let (mut answered, mut pictured) = (Vec::new(), Vec::new());
    for key in ["L", "H"].repeat(7) {
        let pressed = desk.press(key);
        let drawn = desk.settle();
        answered.extend(first(&drawn, pressed, |drawn| drawn.fields));
        pictured.extend(first(&drawn, pressed, Drawn::is_new_picture));
    }
    let (name, target) = (case.name, case.target);
    times_row(&format!("{name}: {what} to field"), &answered, "-");
    times_row(&format!("{name}: {what} to picture"), &pictured, target);
}

/// Another program makes the first sphere alternately larger and smaller, first without and then
/// with keys pressed.
fn save(desk: &mut Desk, case: &Case, text: &str) {
    let path = desk.folder.path().join("scene.ray");
    let larger = with_larger_sphere(text);
    let (mut pictured, mut answered) = (Vec::new(), Vec::new());
    for text in [&larger, text].repeat(5) {
        let at = put(&path, text);
        desk.record(at + 3 * SECOND);
        desk.rest();
        pictured.extend(first(&desk.look(), at, Drawn::is_new_picture));
    }
    for text in [&larger, text].repeat(2) {
        let at = put(&path, text);
        // Down and up, never beyond an end of the list, where a key changes nothing.
        let pressed = desk.press_all(["j", "k"].repeat(18), Duration::from_millis(41));
        desk.record(at + 3 * SECOND);
        desk.rest();
        answered.extend(each(&desk.look(), &pressed, |drawn| drawn.list));
    }
    let name = case.name;
    times_row(
        &format!("{name}: save to picture"),
        &pictured,
        case.from_disk,
    );
    times_row(
        &format!("{name}: key to list, reading"),
        &answered,
        "p95 <= 16, max 33",
    );
}

/// Another program changes the last sphere while the first has unsaved edits and keys are pressed.
/// All edits are undone at the end.
fn merge(desk: &mut Desk, case: &Case, text: &str) {
    let path = desk.folder.path().join("scene.ray");
    let (head, last) = text.rsplit_once("sphere\n").expect("there are spheres");
    let changed = format!("{head}{}", with_larger_sphere(&format!("sphere\n{last}")));
    down(desk, &["gg", "j"]);
    down(desk, &vec!["j"; case.row]);
    down(desk, &["e", "j", "L", "\x1b"]);
    let (mut merged, mut answered) = (Vec::new(), Vec::new());
    for text in [&changed, text].repeat(3) {
        let at = put(&path, text);
        let pressed = desk.press_all(["j", "k"].repeat(18), Duration::from_millis(41));
        desk.record(at + 3 * SECOND);
        desk.rest();
        let drawn = desk.look();
        merged.extend(first(&drawn, at, |drawn| drawn.text.contains("merged")));
        answered.extend(each(&drawn, &pressed, |drawn| drawn.list));
    }
    let name = case.name;
    times_row(&format!("{name}: save, merged"), &merged, case.from_disk);
    times_row(
        &format!("{name}: key to list, merging"),
        &answered,
        "p95 <= 16, max 33",
    );
    for _ in 0..7 {
        down(desk, &["u"]);
    }
}

/// Replaces a file atomically and returns the time.
fn put(path: &Path, text: &str) -> Instant {
    let new = path.with_extension("new");
    std::fs::write(&new, text).expect("the folder is writable");
    let at = Instant::now();
    std::fs::rename(&new, path).expect("the file is replaced");
    at
}

fn with_larger_sphere(text: &str) -> String {
    let (head, rest) = text.split_once("sphere\n").expect("there are spheres");
    let (centre, rest) = rest.split_once('\n').expect("its material follows");
    let (centre, radius) = centre.rsplit_once(' ').expect("its radius is the last");
    let radius: f64 = radius.parse().expect("a number");
    format!("{head}sphere\n{centre} {}\n{rest}", 1.2 * radius)
}

fn down(desk: &mut Desk, keys: &[&str]) {
    for key in keys {
        desk.press(key);
        desk.record(Instant::now() + Duration::from_millis(100));
    }
    desk.rest();
    desk.look();
}
