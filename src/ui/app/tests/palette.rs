//! The command line: completions, actions by name, and history.

use super::scripts::{ray, scripts};
use super::*;
use crate::app::command;

scripts! {
    commands_and_actions_are_offered_by_name_and_description: ray().table("{1} | completed …{2} [{3}]; …", r"
        :ren      | :render                              | F5 r
        :write    | :w [FILE]                            | w
        :outl     | toggle the outline of the selection  | o
        :undo     | undo                                 | u
        :orbit l  | orbit left                           | VIEW h ←
        :view sav | :view save [NAME]                    | S
    ");

    everyday_words_find_what_they_mean: ray().table("{1} | completed …{2} […]; …", r"
        :screenshot | :export [FILE] [WxH] [SPP]
        :gif        | :export [FILE] [WxH] [SPP]
        :image      | :export [FILE] [WxH] [SPP]
        :video      | :export [FILE] [WxH] [SPP]
        :video      | :track [FILE]
        :turntable  | :track [FILE]
        :animation  | :track [FILE]
        :gamma      | :transfer srgb
        :resolution | :size WxH
        :material   | edit its fields
        :color      | pick a colour
        :exit       | :q
        :brightness | :exposure STOPS
        :why        | explain the pixel
        :shadow     | explain the pixel
        :remove     | delete
    ");

    a_line_with_several_matches_stays_until_one_is_chosen: ray().play(r"
        :zzz           | not completed

        :nudge<Enter>  | says several match: Tab chooses | prompt :nudge
        <Tab><Enter>   | not prompt

        :view<Enter>   | says view save, or view light, or view reset?…

        :size 3<Enter> | says :size needs WIDTHxHEIGHT, such as 800x600…

        :zzz<Enter>    | says Nothing for `zzz`
    ");

    tab_and_arrows_choose_and_the_typed_line_is_among_the_choices: ray().play(r"
        :view<Space> | completed :view save [NAME] […]; :view light […]; …
        <Tab>        | prompt :view save
        <Down>       | prompt :view light
        <Up>         | prompt :view save
        <Up>         | prompt :view\s
        <Tab><Tab>   | prompt :view light
        <Back>       | prompt :view ligh
    ");

    actions_run_by_their_descriptions: ray().play(r"
        :next light<Tab><Enter>  | at light 1
        // A unique description need not be chosen.
        :move the camera<Enter>  | mode VIEW
        // The mode that has the key is entered.
        <Esc>:orbit left<Enter>  | mode VIEW | moved
        :render<Enter>           | mode TRACE
    ");

    themes_are_completed_and_chosen: ray().play(r"
        :theme<Space> | completed :theme dark […]; :theme light […]; :theme mono […]; …
        light<Enter>  | theme Light
    ");

    earlier_lines_return_while_the_line_is_empty_or_unchanged: ray().play(r"
        :size 8x8<Enter>:view reset<Enter>:view reset<Enter>:
        <Up>   | prompt :view reset
        <Up>   | prompt :size 8x8
        <Up>   | prompt :size 8x8
        <Down> | prompt :view reset
        <Down> | prompt :
        <Down> | prompt :export
    ");

    file_names_are_completed_from_their_folder: ray().play(r"
        :w s       | lists list .
        // It is on its way.
        c          | not lists
        @listed . a.ray scene.bmp scene.ray scenes/ | completed scene.ray […]; scenes/ […];…
        <Tab><Tab> | prompt :w scenes/
        x          | lists list scenes/
        <Esc>:export<Space>
        @listed . a.ray scene.bmp scene.ray scenes/
        | completed :export cancel […]; scene.bmp […]; scenes/ […];…
    ");
}

#[test]
fn every_action_of_a_key_is_offered_by_its_description() {
    for named in open(SCENE).shared.keymap.actions(Mode::Select) {
        let mut app = open(SCENE);
        press(&mut app, &format!(":{}", named.words));
        let mut found = command::completions(&app.shared)
            .into_iter()
            .chain(command::command_typed(&app.shared));
        let is_offered =
            |found: Completion| found.shown == named.words || found.keys.ends_with(&named.keys);
        assert!(found.any(is_offered), "{named:?}");
    }
}

/// Everyday words, each with the start of a command or of what a key does that must be among the first
/// three found; a command and its key are one.
const EVERYDAY: &str = "
screenshot :export
gif :export
animation :track
turntable :track
gamma :transfer
resolution :size
material edit its fields
exit :q
brightness :exposure
why explain the pixel
image :export
video :export
shadow explain the pixel
color pick a colour
colour pick a colour
remove delete
clone duplicate
rotate rotate
spin rotate
resize scale
save :w
open :e
import :mesh
undo undo
find filter the list
quit :q
help :help
fullscreen show or hide the panels
hide show or hide the object
noise :denoise|reduce noise
quality :render
diff :compare|compare with the reference
versus :compare
pixel inspect a pixel of the picture
wireframe show a wireframe
keyframe key the value
fov narrow
depth show depth
normals show normals
theme :theme dark
dark :theme dark
errors errors and warnings
log messages so far
vim open the editor
lamp add
jpg :export
screnshot :export
exprot :export
take a screenshot :export
how do I quit :q
change the brightness :exposure
";

#[test]
fn everyday_words_find_what_they_mean_in_palette_and_help_alike() {
    let mut missed = Vec::new();
    for line in EVERYDAY.trim().lines() {
        let mut app = open(SCENE);
        let is_expected = |found: &[String], wanted: &str| {
            let mut first = found.iter().take(3);
            first.any(|found| wanted.split('|').any(|wanted| found.starts_with(wanted)))
        };
        let at = line
            .find(" :")
            .or_else(|| line.find(' '))
            .expect("a row has two parts");
        let (typed, wanted) = (&line[..at], line[at..].trim_start());
        press(&mut app, &format!(":{typed}"));
        let palette = command::completions(&app.shared).into_iter();
        let palette: Vec<_> = palette.map(|found| found.shown).collect();
        let help = command::found_in_help(&app.shared, typed).into_iter();
        let help = help.map(|(entry, _)| match entry.keys.strip_prefix(':') {
            Some(_) => entry.keys,
            None => entry.words,
        });
        let help: Vec<_> = help.collect();
        for (place, found) in [("palette", &palette), ("help", &help)] {
            if !is_expected(found, wanted) {
                let first = found.iter().take(4).collect::<Vec<_>>();
                missed.push(format!("{place}: {typed} → {first:?}, not {wanted}"));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
