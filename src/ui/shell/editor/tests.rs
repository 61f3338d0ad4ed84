use super::*;

/// Names that an editor, a shell or a parser of positions might misinterpret.
const NAMES: &[&str] = &[
    "plain.ray",
    "+sil !id>canary.ray",
    "+12.ray",
    "+/id.ray",
    "-c !id.ray",
    "--cmd=!id.ray",
    "-.ray",
    ":!id.ray",
    "!id>canary.ray",
    "@id.ray",
    "|id.ray",
    "~.ray",
    "~root.ray",
    "#1.ray",
    "%.ray",
    "two words.ray",
    " leading.ray",
    "it's.ray",
    "\"quoted\".ray",
    "back\\slash.ray",
    ";id;.ray",
    "$(id).ray",
    "`id`.ray",
    "$HOME.ray",
    "*.ray",
    "{a,b}.ray",
    "[ab].ray",
    "(1,2).ray",
    "a:12.ray",
    "a:12:3:b.ray",
    "line\nbreak.ray",
    "ssh:host:b.ray",
];

/// The arguments that editors get for `/d/NAME` at line 7, and for a name with a colon if they
/// differ.
const EDITORS: &[(&str, &str, Option<&str>)] = &[
    ("vi /usr/bin/vim vim.basic nvim", "+7 -- FILE", None),
    ("view kak emacs emacs-nox emacs29", "+7 -- FILE", None),
    ("nano micro emacsclient", "-- +7 FILE", None),
    ("mg unheard-of", "+7 FILE", None),
    ("ed", "FILE", None),
    ("hx helix", "-- FILE:7", Some("FILE")),
    ("subl zed", "FILE:7", Some("FILE")),
    ("code code-insiders codium", "--goto FILE:7", Some("FILE")),
];

#[test]
fn every_name_reaches_every_editor_as_a_file() {
    for (programs, plain, with_colon) in EDITORS {
        for name in NAMES {
            let file = format!("/d/{name}");
            let form = with_colon.filter(|_| name.contains(':')).unwrap_or(plain);
            let word = |word: &str| OsString::from(word.replace("FILE", &file));
            let expected: Vec<_> = form.split(' ').map(word).collect();
            let place = place(Path::new(&file)).expect("an absolute path");
            for program in programs.split(' ') {
                assert_eq!(arguments(program, &place, 7), *expected, "{program}");
            }
        }
    }
}

#[test]
fn paths_become_absolute_with_single_slashes() {
    let here = env::current_dir().expect("a current folder");
    for name in NAMES {
        let expected = here.join(name);
        assert_eq!(place(Path::new(name)).expect(name), expected);
    }
    for (said, expected) in [
        ("/a//b/./c.ray", "/a/b/c.ray"),
        ("//a.ray", "/a.ray"),
        ("/a/../b.ray", "/a/../b.ray"),
        // neovim runs `term://COMMAND`.
        ("/d/term://id.ray", "/d/term:/id.ray"),
    ] {
        let place = place(Path::new(said)).expect(said);
        assert_eq!(place.as_os_str(), expected);
    }
}

#[test]
fn emacs_does_not_contact_another_host() {
    for (file, expected) in [
        ("/ssh:host:/a.ray", "/:/ssh:host:/a.ray"),
        ("/sudo::b/a.ray", "/:/sudo::b/a.ray"),
        ("/d/ssh:host:/a.ray", "/d/ssh:host:/a.ray"),
    ] {
        for program in ["emacs", "emacsclient"] {
            let arguments = arguments(program, Path::new(file), 1);
            assert_eq!(arguments.last().expect("a file"), expected);
        }
    }
}

/// helix takes an existing `a.ray:7` for the file itself.
#[test]
fn a_file_whose_name_ends_in_the_line_number_is_not_opened_instead() {
    let place = tempfile::tempdir().expect("a folder");
    let scene = place.path().join("a.ray");
    std::fs::write(place.path().join("a.ray:7"), "").expect("the folder is new");
    assert_eq!(arguments("hx", &scene, 7), [scene.as_os_str()]);
    assert_eq!(arguments("hx", &scene, 8).len(), 2);
}

#[test]
fn commands_are_split_like_in_a_shell() {
    for (said, expected) in table! {
        "vim" => &["vim"][..];
        " code  --wait " => &["code", "--wait"];
        "'/opt/my editor/vim' -u NONE" => &["/opt/my editor/vim", "-u", "NONE"];
        "/opt/my\\ editor/vim" => &["/opt/my editor/vim"];
        "vim -c \"set nu\" ''" => &["vim", "-c", "set nu", ""];
        "vim $HOME `id` $(id); id" => &["vim", "$HOME", "`id`", "$(id);", "id"];
    } {
        assert_eq!(words(said).expect(said), expected);
    }
    let refused = words("vim 'x").expect_err("no second quote");
    assert_eq!(refused, "`vim 'x` ends within a quote or after a backslash");
}

#[test]
fn only_absolute_paths_may_contain_unquoted_spaces() {
    let place = tempfile::tempdir().expect("a folder");
    let program = place.path().join("my editor");
    let said = program.to_str().expect("a plain path");
    assert_eq!(words(said).map(|words| words.len()), Ok(2));
    std::fs::write(&program, "").expect("the folder is new");
    assert_eq!(words(said), Ok(vec![said.to_owned()]));
}
