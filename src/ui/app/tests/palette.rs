//! The command line: completions, actions by name, and history.

use super::*;

fn line(app: &App) -> &str {
    app.overlays
        .prompt
        .as_ref()
        .map_or("", |prompt| prompt.input.value())
}

fn offered(app: &App) -> Vec<String> {
    let found = app.completions().into_iter();
    found.map(|completion| completion.shown).collect()
}

#[test]
fn commands_and_actions_are_offered_by_name_and_description() {
    for (said, first, keys) in [
        (":ren", ":render", "F5 r"),
        (":write", ":w [FILE]", "w"),
        (":outl", "toggle the outline of the selection", "o"),
        (":undo", "undo", "u"),
        (":orbit l", "orbit left", "VIEW h ←"),
        (":view sav", ":view save [NAME]", "S"),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        let found = app.completions();
        let found = found.iter().find(|completion| completion.shown == first);
        assert_eq!(
            found.map(|found| &*found.keys),
            Some(keys),
            "{said}: {:?}",
            offered(&app)
        );
    }
    let mut app = open(SCENE);
    press(&mut app, ":zzz");
    assert!(offered(&app).is_empty());
}

#[test]
fn a_line_with_several_matches_stays_until_one_is_chosen() {
    let mut app = open(SCENE);
    press(&mut app, ":nudge<Enter>");
    assert_eq!(words(&app), "several match: Tab chooses");
    assert_eq!(line(&app), "nudge");
    press(&mut app, "<Tab><Enter>");
    assert!(app.overlays.prompt.is_none());
    for (said, reason) in [
        (":view<Enter>", "view save, or view light, or view reset?"),
        (":size 3<Enter>", "size takes a size such as 800x600"),
        (":zzz<Enter>", "unknown command `zzz`"),
    ] {
        let mut app = open(SCENE);
        press(&mut app, said);
        assert!(words(&app).starts_with(reason), "{said}: {}", words(&app));
    }
}

#[test]
fn tab_and_arrows_choose_and_the_typed_line_is_among_the_choices() {
    let mut app = open(SCENE);
    press(&mut app, ":view ");
    assert_eq!(offered(&app)[..2], [":view save [NAME]", ":view light"]);
    for (key, expected) in [
        ("<Tab>", "view save"),
        ("<Down>", "view light"),
        ("<Up>", "view save"),
        ("<Up>", "view "),
        ("<Tab><Tab>", "view light"),
        ("<Back>", "view ligh"),
    ] {
        press(&mut app, key);
        assert_eq!(line(&app), expected, "{key}");
    }
}

#[test]
fn every_action_of_a_key_runs_by_its_description() {
    let mut app = open(SCENE);
    press(&mut app, ":next light<Tab><Enter>");
    assert_eq!(app.selected_row(), 3);
    // A unique description need not be chosen.
    press(&mut app, ":move the camera<Enter>");
    assert_eq!(app.mode, Mode::View);
    // The mode that has the key is entered.
    press(&mut app, "<Esc>:orbit left<Enter>");
    assert!(app.mode == Mode::View && app.pictures.view.is_some());
    press(&mut app, ":render<Enter>");
    assert_eq!(app.mode, Mode::Trace);
    for named in open(SCENE).keymap.actions(Mode::Select) {
        let mut app = open(SCENE);
        press(&mut app, &format!(":{}", named.words));
        let mut found = app.completions().into_iter().chain(app.command_typed());
        let is_offered =
            |found: Completion| found.shown == named.words || found.keys.ends_with(&named.keys);
        assert!(found.any(is_offered), "{named:?}");
    }
}

#[test]
fn themes_are_completed_and_chosen() {
    use crate::ui::theme::Theme;
    let mut app = open(SCENE);
    press(&mut app, ":theme ");
    assert_eq!(
        offered(&app)[..3],
        [":theme dark", ":theme light", ":theme mono"]
    );
    press(&mut app, "light<Enter>");
    assert_eq!(app.theme, Theme::Light);
}

#[test]
fn earlier_lines_return_while_the_line_is_empty_or_unchanged() {
    let mut app = open(SCENE);
    press(
        &mut app,
        ":size 8x8<Enter>:view reset<Enter>:view reset<Enter>:",
    );
    for (key, expected) in [
        ("<Up>", "view reset"),
        ("<Up>", "size 8x8"),
        ("<Up>", "size 8x8"),
        ("<Down>", "view reset"),
        ("<Down>", ""),
        ("<Down>", "w"),
    ] {
        press(&mut app, key);
        assert_eq!(line(&app), expected, "{key}");
    }
}

#[test]
fn file_names_are_completed_from_their_folder() {
    let mut app = open(SCENE);
    let effects = press_all(&mut app, ":w s");
    let listed = |effects: &[Effect]| {
        effects.iter().find_map(|effect| match effect {
            Effect::ListFolder(folder) => Some(folder.clone()),
            _ => None,
        })
    };
    assert_eq!(listed(&effects), Some(PathBuf::from(".")));
    assert_eq!(listed(&press_all(&mut app, "c")), None, "it is on its way");
    let names = ["a.ray", "scene.bmp", "scene.ray", "scenes/"].map(str::to_owned);
    app.update(Msg::Listed(PathBuf::from("."), names.to_vec()));
    assert_eq!(offered(&app), ["scene.ray", "scenes/"]);
    press(&mut app, "<Tab><Tab>");
    assert_eq!(line(&app), "w scenes/");
    let effects = press_all(&mut app, "x");
    assert_eq!(listed(&effects), Some(PathBuf::from("scenes/")));
    press(&mut app, "<Esc>:export ");
    app.update(Msg::Listed(PathBuf::from("."), names.to_vec()));
    assert_eq!(offered(&app), [":export cancel", "scene.bmp", "scenes/"]);
}
