//! Where the selected thing is in the picture.

use super::super::scripts::{scene, scripts};
use super::*;
use crate::service::locate;

/// Balls before the default view: one in front of another, one far to the right, one behind the camera,
/// and a lamp that none of the first two sees, as a third is around it.
const RAY: &str = "\
0 0 0
2
0 9 9  1 1 1
-30 0 0  1 1 1
4
sphere 0 0 0 1   0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 0 0 -3 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 900 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere -30 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1
// view: eye 0 0 9 target 0 0 0 up 0 1 0 fov 40 size 800 600
";

scripts! {
    the_panel_opens_follows_the_selection_and_closes: scene("a.ray", RAY).play(r"
        [object 1] W  | does locate
        j             | does locate
        j             | does locate
        <Esc>         | mode SELECT | not does locate
        W             | does locate
        e             | mode EDIT
        <Esc>         | mode EDIT
        <Esc>         | mode SELECT
    ");
}

#[test]
fn what_is_said_is_what_the_picture_shows() {
    let cases: [(&str, &[&str]); 6] = [
        (
            "",
            &[
                "seen 5.5 % of the picture, about 26,400 pixels of 800×600",
                "lit by light 1 (",
                "not by light 2: in shadow of object 4",
                "changes 4.5 %",
            ],
        ),
        ("j", &["seen ", "hidden ", "by object 1 "]),
        (
            "jj",
            &["seen outside the picture, to the right", "changes nothing"],
        ),
        ("jjj", &["seen outside the picture, to the left"]),
        (
            "k",
            &[
                "stands outside the picture, to the left",
                "lights nothing",
                "changes nothing",
            ],
        ),
        ("kk", &["lights object 1 ", "changes "]),
    ];
    for (keys, expected) in cases {
        let mut session = scene("a.ray", RAY).session();
        session.run(&format!("[object 1] W{keys}"));
        let search = session
            .effects
            .iter()
            .rev()
            .find_map(|effect| match effect {
                Effect::Locate(search) => Some(search.clone()),
                _ => None,
            });
        let search = search.expect("it is asked");
        let found = locate(&search, &|| false).map(Box::new);
        assert!(locate(&search, &|| true).is_none());
        session.update(Msg::Located(search.ticket, found));
        let lines = crate::app::whereabouts::lines(&session.app.whereabouts, &session.app.shared);
        let lines: Vec<_> = lines
            .iter()
            .map(|(label, words)| format!("{label} {words}"))
            .collect();
        let said = lines.join("\n");
        for part in expected {
            assert!(said.contains(part), "{keys}: {part:?} is not in\n{said}");
        }
    }
}
