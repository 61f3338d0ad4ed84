//! Scenes edited in the interface and from outside.

use super::*;

/// A ball with the colours of a picture file, lit only by ambient light.
const TEXTURED: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .02 .02
viewport 40 30
light ID 0 amb 0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_off
mat ID 0  1 1 1  1 0 0 1  0 0 1
texture ID 0 image 1 1 skin.ppm
use colour ID 0 mat ID 0
obj sphere ID 0 mat ID 0  0 0 0  2
";

/// A triangle from a file, lit only by ambient light.
const MESHED: &str = "<xml><scene><light type='ambient'><intensity value='1'/></light>
  <object type='obj' name='a.obj'/></scene>
  <camera><position z='8'/><target/></camera></xml>
";

#[test]
fn a_scene_is_edited_shown_reloaded_and_exported() {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
    let mut session = place.start(&["default.ray"], WIDE);
    wait_for_rest(&mut session);
    assert!(!session.has_settings_from_before(), "keys come unbuffered");
    let opened = picture(session.screen());

    session.send(["ggjj", ENTER, "2", ENTER].concat());
    session.wait_for("default.ray [+]");
    wait_for_change(&mut session, &opened);
    assert_eq!(place.read("default.ray"), DEFAULT);

    session.send("w");
    session.wait_for("wrote default.ray");
    wait_until_gone(&mut session, "[+]");
    let saved = DEFAULT.replacen("0.5 0.55 0.75 ", "2 0.55 0.75   ", 1);
    assert_eq!(place.read("default.ray"), saved);

    let bright = picture(session.screen());
    let darker = saved.replacen("2 0.55 0.75 ", "0 0 0 ", 1);
    place.replace("default.ray", &darker);
    wait_for_change(&mut session, &bright);
    let dark = picture(session.screen());

    let broken = darker.replacen("\n26\n", "\n -26\n", 1);
    let line = 1 + broken[..broken.find(" -26").expect("the error")]
        .matches('\n')
        .count();
    place.replace("default.ray", &broken);
    session.wait_for("STALE");
    session.wait_for(&format!("default.ray:{line}:2 "));
    // It is scaled to the place that the error leaves.
    let kept = picture(session.screen());
    assert!(!kept.is_empty() && kept.len() <= dark.len());

    place.replace("default.ray", &darker);
    wait_until_gone(&mut session, "STALE");
    session.wait("waiting for the picture in its former size", |screen| {
        is_at_rest(screen) && picture(screen) == dark
    });

    session.send(":export out.bmp 64x48 1\r");
    session.wait_for("wrote out.bmp");
    let arguments = "render default.ray -o again.bmp --size 64x48 --spp 1";
    let rendered = Command::new(env!("CARGO_BIN_EXE_halflight"))
        .args(arguments.split(' '))
        .current_dir(place.directory.path())
        .stderr(Stdio::null())
        .status();
    assert!(rendered.expect("it starts").success());
    let [exported, again] = ["out.bmp", "again.bmp"].map(|name| fs::read(place.at(name)));
    assert!(exported.expect("a picture") == again.expect("a picture"));
    quit(session);
}

#[test]
fn unsaved_edits_are_merged_with_changes_of_the_file() {
    let place = Place::new();
    let mut session = place.open_edited();
    let theirs = |text: &str| text.replacen("0 1 0  0", "0 0 1  0", 1);
    place.replace("balls.ray", &theirs(BALLS));
    wait_for_colour(&mut session, BLUE);
    session.wait_for("balls.ray [+]");
    assert_eq!(place.read("balls.ray"), theirs(BALLS));
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert_eq!(place.read("balls.ray"), theirs(&edited()));
    quit(session);
}

#[test]
fn a_number_changed_on_both_sides_causes_a_question() {
    let theirs = BALLS.replacen(".80", "0.5", 1);
    let cases = [
        ("m", edited(), "wrote balls.ray"),
        ("t", theirs.clone(), "nothing to save"),
    ];
    for (key, chosen, message) in cases {
        let place = Place::new();
        let mut session = place.open_edited();
        place.replace("balls.ray", &theirs);
        session.wait_for("The file changed too");
        // If postponed, the question returns before anything is written.
        session.send(ESC);
        session.wait_for("[disk changed]");
        wait_until_gone(&mut session, "The file changed too");
        session.send("w");
        session.wait_for("The file changed too");
        assert_eq!(place.read("balls.ray"), theirs);
        session.send([key, ENTER].concat());
        wait_until_gone(&mut session, "[disk changed]");
        session.send(":w\r");
        session.wait_for(message);
        assert_eq!(place.read("balls.ray"), chosen, "after {key}");
        quit(session);
    }
}

#[test]
fn a_scene_with_errors_opens_with_their_list() {
    let place = Place::new();
    place.write("balls.ray", &BALLS.replacen(".80", "-.80", 1));
    let mut session = place.start(&["balls.ray"], (80, 24));
    session.wait_for("balls.ray:4:15");
    session.wait_for("1 error");
    place.replace("balls.ray", BALLS);
    wait_for_rest(&mut session);
    assert!(!session.text().contains("error"));
    quit(session);
}

#[test]
fn the_embedded_scene_is_saved_under_a_name() {
    let place = Place::new();
    let mut session = place.start(&[], WIDE);
    wait_for_rest(&mut session);
    session.send(["ggjj", ENTER, "2", ENTER, "w"].concat());
    session.wait_for(":w ");
    session.send("mine.ray\r");
    session.wait_for("wrote mine.ray");
    let saved = DEFAULT.replacen("0.5 0.55 0.75 ", "2 0.55 0.75   ", 1);
    assert_eq!(place.read("mine.ray"), saved);
    quit(session);
}

#[test]
fn a_pasted_colour_is_one_undo_step() {
    let place = Place::new();
    let mut session = place.open();
    session.send("\rjj");
    session.send("\x1b[200~#ff8000\x1b[201~");
    wait_for_colour(&mut session, Color::Rgb(255, 128, 0));
    session.send("w");
    session.wait_for("wrote balls.ray");
    let pasted = BALLS.replacen("1 0 0  0", "1 0.502 0  0", 1);
    assert_eq!(place.read("balls.ray"), pasted);
    session.send("u");
    wait_for_colour(&mut session, RED);
    session.send("w");
    session.wait_for("wrote balls.ray");
    assert_eq!(place.read("balls.ray"), BALLS);
    quit(session);
}

#[test]
fn a_click_selects_the_object_under_it() {
    let place = Place::new();
    let mut session = place.open();
    let mode = session.screen().mouse_protocol_mode();
    assert_eq!(mode, MouseProtocolMode::ButtonMotion);
    for (colour, name) in [(GREEN, "▸ ● the green one"), (RED, "▸ ● the red one")] {
        let Pixels { row, column, .. } = wait_for_colour(&mut session, colour);
        let at = format!("0;{};{}", column + 1, row + 1);
        session.send(format!("\x1b[<{at}M\x1b[<{at}m"));
        session.wait_for(name);
    }
    quit(session);
}

#[test]
fn the_picture_follows_changes_of_its_texture_files() {
    let skin = |colour: &str| format!("P3\n1 1\n255\n{colour}\n");
    let place = Place::new();
    place.write("ball.dat", TEXTURED);
    for arguments in [&["ball.dat"][..], &["--poll=20", "ball.dat"]] {
        place.write("skin.ppm", &skin("255 0 0"));
        let mut session = place.start(arguments, WIDE);
        wait_for_colour(&mut session, RED);
        place.replace("skin.ppm", &skin("0 0 255"));
        wait_for_colour(&mut session, BLUE);

        // Half a picture changes nothing but is reported.
        place.write("skin.ppm", "P3\n1 1\n255\n0");
        session.wait_for("cannot read 1 file: press ! to see why");
        session.send("!");
        session.wait_for("its last picture is kept");
        wait_for_colour(&mut session, BLUE);
        session.send(ESC);
        place.write("skin.ppm", &skin("0 255 0"));
        wait_for_colour(&mut session, GREEN);
        quit(session);
    }
}

/// Files that are named by a scene's files are watched too.
#[test]
fn the_picture_follows_changes_of_meshes_libraries_and_their_pictures() {
    let mesh = |material: &str| {
        let corners = "v -3 -3 0\nv 3 -3 0\nv 0 3 0";
        format!("mtllib a.mtl\n{corners}\nusemtl {material}\nf 1 2 3\n")
    };
    let library = |of_a: &str| format!("newmtl a\n{of_a}\nnewmtl b\nKd 0 0 1\n");
    let place = Place::new();
    place.write("mesh.xml", MESHED);
    for arguments in [&["mesh.xml"][..], &["--poll=20", "mesh.xml"]] {
        place.write("a.obj", &mesh("a"));
        place.write("a.mtl", &library("Kd 1 0 0"));
        let mut session = place.start(arguments, WIDE);
        wait_for_colour(&mut session, RED);
        place.replace("a.mtl", &library("Kd 0 1 0"));
        wait_for_colour(&mut session, GREEN);
        place.replace("a.obj", &mesh("b"));
        wait_for_colour(&mut session, BLUE);

        place.write("a.obj", "v 1 2\n");
        session.wait_for("cannot read 1 file: press ! to see why");
        session.send("!");
        session.wait_for("a.obj:1:6 v: expected 3 numbers");
        session.wait_for("the object is left out");
        session.send(ESC);
        place.write("a.obj", &mesh("a"));
        wait_for_colour(&mut session, GREEN);
        quit(session);
    }
}

/// A relative path moves with the current folder; an absolute one waits for its folder to return.
#[test]
fn a_scene_is_followed_when_its_folder_is_moved() {
    let green = BALLS.replacen("1 0 0  0 0 0", "0 0 1  0 0 0", 1);
    for poll in [&[][..], &["--poll=20"]] {
        let place = Place::new();
        let (here, there) = (place.at("here"), place.at("there"));
        fs::create_dir(&here).expect("a folder");
        place.write("here/balls.ray", BALLS);

        let arguments = [&["--color", "24", "balls.ray"], poll].concat();
        let mut relative = Session::start(&here, &arguments, WIDE, &[]);
        let path = here.join("balls.ray").display().to_string();
        let arguments = [&["--color", "24", &path], poll].concat();
        let mut absolute = Session::start(place.directory.path(), &arguments, WIDE, &[]);
        wait_for_colour(&mut relative, RED);
        wait_for_colour(&mut absolute, RED);

        fs::rename(&here, &there).expect("renamed");
        absolute.wait_for("[file missing]");
        place.write("there/balls.ray", &green);
        wait_for_colour(&mut relative, BLUE);
        assert!(!relative.text().contains("missing"));

        fs::rename(&there, &here).expect("renamed");
        wait_for_colour(&mut absolute, BLUE);
        place.write("here/balls.ray", BALLS);
        for mut session in [relative, absolute] {
            wait_for_colour(&mut session, RED);
            quit(session);
        }
    }
}

/// Waits for the blue ball of the folder that took the place of the scene's, and saves the edit there.
fn assert_follows(place: &Place, mut session: Session) {
    wait_for_colour(&mut session, BLUE);
    session.send(":w\r");
    session.wait_for("wrote ");
    assert_eq!(
        place.read("scenes/balls.ray"),
        edited().replacen("0 1 0  0", "0 0 1  0", 1)
    );
    quit(session);
}

/// As by `mv scenes old; mv new scenes; rm -r old`.
#[test]
fn a_scene_is_followed_to_the_first_place_of_its_folder() {
    let place = Place::new();
    let [folder, new, old] = ["scenes", "new", "old"].map(|name| place.at(name));
    for (folder, colour) in [(&folder, "0 1 0  0"), (&new, "0 0 1  0")] {
        fs::create_dir(folder).expect("it is new");
        let text = BALLS.replacen("0 1 0  0", colour, 1);
        fs::write(folder.join("balls.ray"), text).expect("written");
    }
    let arguments = ["--color", "24", "balls.ray"];
    let mut session = Session::start(&folder, &arguments, WIDE, &[]);
    wait_for_rest(&mut session);
    session.send(RADIUS_TO_2);
    session.wait_for("balls.ray [+]");
    fs::rename(&folder, &old).expect("renamed");
    fs::rename(&new, &folder).expect("renamed");
    // Seen where it is now, so that this is another place it has had.
    session.send(":e\r");
    session.wait_for("balls.ray [+]");
    fs::remove_dir_all(&old).expect("removed");
    assert_follows(&place, session);
}

/// As `git switch` does with folders that are not in the other branch.
#[test]
fn a_scene_is_followed_into_the_folder_that_takes_the_place_of_its_own() {
    let place = Place::new();
    let folder = place.at("scenes");
    let home = place.at("");
    let environment = [("HOME", home.to_str().expect("a text"))];
    for name in ["balls.ray", "./balls.ray"] {
        fs::create_dir_all(&folder).expect("created");
        place.write("scenes/balls.ray", BALLS);
        let arguments = ["--color", "24", name];
        let mut session = Session::start(&folder, &arguments, WIDE, &environment);
        wait_for_rest(&mut session);
        session.send(RADIUS_TO_2);
        session.wait_for("balls.ray [+]");

        fs::remove_dir_all(&folder).expect("removed");
        session.wait_for("scenes: no such folder; save the scene elsewhere with :w FILE");
        session.send(":w\r");
        session.wait_for("scenes: no such folder; save elsewhere with :w FILE");

        fs::create_dir(&folder).expect("created");
        place.write(
            "scenes/balls.ray",
            &BALLS.replacen("0 1 0  0", "0 0 1  0", 1),
        );
        assert_follows(&place, session);
    }
}
