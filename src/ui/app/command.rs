//! The command line after `:`: one table of commands, shared by the parser, the help and the
//! README, and what each command does.

use std::path::PathBuf;

use super::drawing::RegionOrder;
use super::exports::ExportOrder;
use super::jobs::Asking;
use super::setting::SettingOrder;
use super::until::Until;
use super::zooming::ScaleOrder;
use super::{App, Help, Next, PromptKind};
use crate::document::StepName;
use crate::image_file::ImageFormat;
use crate::language::{Language, extensions};
use crate::render::{Aov, MOST_HALF_STOPS};
use crate::scene::{Camera, Size, Transfer};
use crate::text::{Severity, nearest_word};
use crate::ui::keymap::{self, HelpLine, Mode};
use crate::ui::msg::{Effect, Guard};
use crate::ui::pixels::Pixels;
use crate::ui::theme::Theme;

/// A parsed command line.
#[derive(Clone, Debug, PartialEq)]
enum Command {
    /// Save, optionally to another file.
    Write(Option<PathBuf>, Force),
    /// Quit; with `!` without asking.
    Quit(Force),
    /// Save, then quit if that succeeds.
    WriteQuit,
    /// Open another scene, or read the file again.
    Edit(Option<PathBuf>),
    /// Start a new scene, in another language if one is given.
    New(Option<Language>),
    /// List recently used scenes.
    Recent,
    /// List the steps of the undo history.
    History,
    /// Export what is shown to a picture file.
    Export(ExportOrder, Asking),
    /// Cancel the running export.
    ExportCancel,
    /// Trace at full size.
    Render,
    /// Compare with the reference, or with another one.
    Compare(Option<PathBuf>),
    /// Write the working view into the text, under a name if one is given.
    ViewSave(Option<String>),
    /// Look from the selected light.
    ViewLight,
    /// Return to the text's view.
    ViewReset,
    /// Play a track.
    Track(Option<PathBuf>),
    /// Set when the full-size trace is complete, or say when it is.
    Until(Option<Until>),
    /// Trace only a region at full size.
    Region(RegionOrder),
    /// Zoom the picture.
    Scale(ScaleOrder),
    /// Set the size of the output picture.
    Size(Size),
    /// Write a render setting into the text.
    Set(SettingOrder),
    /// Add a mesh from a file.
    Mesh(Option<PathBuf>),
    /// Take the mouse or leave it to the terminal.
    Mouse,
    /// Show an AOV.
    Show(Aov),
    /// Set the exposure of the display, in half stops.
    Exposure(i8),
    /// Display light by a transfer function, or by the scene's own.
    Transfer(Option<Transfer>),
    /// Display false colours, or true ones again.
    FalseColour,
    /// Reduce the noise on screen, or no longer.
    Denoise,
    /// Show or hide the histogram.
    Histogram,
    /// Use other colours.
    Theme(Theme),
    /// Draw pixels with something else.
    Pixels(Pixels),
    /// Open the help page.
    Help,
}

/// Whether a command ends with `!`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Force {
    No,
    Yes,
}

/// A row of the table: the spelling of a command and its meaning.
struct CommandRow {
    /// One or two words, and alternative spellings.
    names: &'static [&'static str],
    arguments: Arguments,
    /// Description for the help.
    words: &'static str,
    /// The name of the keys that do the same.
    key: Option<&'static str>,
}

/// The arguments of a command, and how they form its meaning.
enum Arguments {
    Nothing(Command),
    File(fn(Option<PathBuf>) -> Command),
    Name(fn(Option<String>) -> Command),
    Language(fn(Option<Language>) -> Command),
    Picture(fn(ExportOrder) -> Command),
    Size(fn(Size) -> Command),
    /// How they are spelled, and what reads them.
    Said(&'static str, fn(&str) -> Result<Command, String>),
    Pixels(fn(Pixels) -> Command),
}

const fn row(
    names: &'static [&'static str],
    arguments: Arguments,
    words: &'static str,
) -> CommandRow {
    CommandRow {
        names,
        arguments,
        words,
        key: None,
    }
}

impl CommandRow {
    /// Keys with this name do the same.
    const fn key(mut self, name: &'static str) -> Self {
        self.key = Some(name);
        self
    }
}

/// Minimum width of a column of the help page if there are several.
const HELP_COLUMN: u16 = 56;
/// Maximum number of columns of the help page.
const MOST_COLUMNS: usize = 3;

use Arguments as A;
use Command as C;

/// All commands, in the order of the help page.
#[rustfmt::skip]
const TABLE: &[CommandRow] = &[
    row(&["w", "write"], A::File(|file| C::Write(file, Force::No)), "save the scene, or save it as FILE").key("save"),
    row(&["w!", "write!"], A::File(|file| C::Write(file, Force::Yes)), "save, overwriting changes on disk"),
    row(&["q", "quit"], A::Nothing(C::Quit(Force::No)), "quit").key("quit"),
    row(&["q!", "quit!"], A::Nothing(C::Quit(Force::Yes)), "quit without asking"),
    row(&["wq", "x"], A::Nothing(C::WriteQuit), "save and quit"),
    row(&["e", "edit", "reread"], A::File(C::Edit), "open FILE, or reload the scene's own"),
    row(&["new"], A::Language(C::New), "start a new scene: ray, dat or xml"),
    row(&["recent"], A::Nothing(C::Recent), "list recently used scenes"),
    row(&["history", "undolist"], A::Nothing(C::History), "show the undo history as pictures").key("history"),
    row(&["export"], A::Picture(|order| C::Export(order, Asking::No)), "export the picture, in SEQUENCE all frames").key("export"),
    row(&["export!"], A::Picture(|order| C::Export(order, Asking::Forced)), "export, overwriting an existing file"),
    row(&["export cancel"], A::Nothing(C::ExportCancel), "cancel the export").key("stop"),
    row(&["render"], A::Nothing(C::Render), "trace at full size").key("trace"),
    row(&["compare"], A::File(C::Compare), "compare with a picture or scene FILE, saved, or git [REVISION]").key("compare"),
    row(&["until"], A::Said(" [N spp|TIME|noise E]", until), "end the full-size trace at N spp, after 30 s or 5 min, or below noise 0.01"),
    row(&["region"], A::Said(" [X,Y,W,H|off]", |said| RegionOrder::parse(said).map(C::Region)), "trace only these pixels at full size, or all").key("region"),
    row(&["zoom"], A::Said(" [fit|1:1|N]", |said| ScaleOrder::parse(said).map(C::Scale)), "zoom the picture, also the preview"),
    row(&["track"], A::File(C::Track), "play the track FILE, or the one beside the scene").key("track"),
    row(&["view save"], A::Name(C::ViewSave), "write the view into the scene, or save it as NAME").key("write-view"),
    row(&["view light"], A::Nothing(C::ViewLight), "look from the selected light"),
    row(&["view reset"], A::Nothing(C::ViewReset), "reset to the scene's view").key("reset-view"),
    row(&["size"], A::Size(C::Size), "set the picture size in the scene"),
    row(&["set"], A::Said(" KEY [VALUE|default]", |said| SettingOrder::parse(said).map(C::Set)), "write a render setting into the scene, by default the one in use"),
    row(&["mesh"], A::File(C::Mesh), "add the mesh of an .obj FILE, named as from the scene"),
    row(&["show uv"], A::Nothing(C::Show(Aov::Uv)), "show texture coordinates: u red, v green"),
    row(&["show side"], A::Nothing(C::Show(Aov::Side)), "show sides of surfaces: front blue, back orange"),
    row(&["exposure"], A::Said(" STOPS", exposure), "set the exposure of the display, in stops"),
    row(&["transfer linear"], A::Nothing(C::Transfer(Some(Transfer::Linear))), "display light linearly"),
    row(&["transfer srgb"], A::Nothing(C::Transfer(Some(Transfer::Srgb))), "display light by the sRGB curve"),
    row(&["transfer scene"], A::Nothing(C::Transfer(None)), "display light as the scene says"),
    row(&["falsecolour", "falsecolor"], A::Nothing(C::FalseColour), "display luminances as false colours, or no longer"),
    row(&["denoise"], A::Nothing(C::Denoise), "reduce the noise of light on screen, or no longer").key("denoise"),
    row(&["histogram"], A::Nothing(C::Histogram), "show or hide the histogram of the light"),
    row(&["mouse"], A::Nothing(C::Mouse), "take the mouse or leave it to the terminal"),
    row(&["theme dark"], A::Nothing(C::Theme(Theme::Dark)), "use colours for dark screens"),
    row(&["theme light"], A::Nothing(C::Theme(Theme::Light)), "use colours for light screens"),
    row(&["theme mono"], A::Nothing(C::Theme(Theme::Mono)), "use no colours except in pictures"),
    row(&["pixels"], A::Pixels(C::Pixels), "set what pixels are drawn with, such as half, octant or auto"),
    row(&["help"], A::Nothing(C::Help), "show this page").key("help"),
];

/// A command as the palette describes it.
pub(super) struct Described {
    pub(super) name: &'static str,
    pub(super) names: &'static [&'static str],
    pub(super) usage: String,
    pub(super) words: &'static str,
    /// The name of the keys that do the same.
    pub(super) key: Option<&'static str>,
    /// Whether its arguments begin with a file name.
    pub(super) takes_file: bool,
}

/// All commands, in the order of the help page.
pub(super) fn all_described() -> impl Iterator<Item = Described> {
    TABLE.iter().map(CommandRow::described)
}

/// The command with exactly this name.
pub(super) fn described_as(name: &str) -> Option<Described> {
    let mut rows = TABLE.iter();
    let row = rows.find(|row| row.names.contains(&name));
    row.map(CommandRow::described)
}

/// The command whose name a line begins with, followed by a blank.
pub(super) fn described_in(line: &str) -> Option<Described> {
    let begins = |name: &&str| {
        line.strip_prefix(*name)
            .is_some_and(|rest| rest.starts_with(' '))
    };
    let rows = TABLE.iter().filter(|row| row.names.iter().any(begins));
    let row = rows.max_by_key(|row| row.names[0].len());
    row.map(CommandRow::described)
}

/// Whether a line can be run.
pub(super) fn is_command(line: &str) -> bool {
    parse(line).is_ok()
}

/// Whether the first word of a line is that of a command, whatever follows.
pub(super) fn begins_command(line: &str) -> bool {
    let first = |words: &str| words.split_whitespace().next().map(str::to_owned);
    let wanted = first(line);
    let mut names = TABLE.iter().flat_map(|form| form.names);
    names.any(|name| first(name) == wanted)
}

impl CommandRow {
    fn described(&self) -> Described {
        let name = self.names[0];
        Described {
            name,
            names: self.names,
            usage: self.usage(),
            words: self.words,
            key: self.key,
            takes_file: matches!(self.arguments, A::File(_) | A::Picture(_)),
        }
    }

    /// The spelling with arguments: `:size WxH`.
    fn usage(&self) -> String {
        let name = self.names[0];
        let arguments = match self.arguments {
            A::Nothing(_) => "",
            A::File(_) => " [FILE]",
            A::Name(_) => " [NAME]",
            A::Language(_) => " [LANGUAGE]",
            A::Picture(_) => " [FILE] [WxH] [SPP]",
            A::Size(_) => " WxH",
            A::Said(usage, _) => usage,
            A::Pixels(_) => " MEANS",
        };
        format!(":{name}{arguments}")
    }

    /// Parses the arguments; the error says what is expected.
    fn parse(&self, rest: &str) -> Result<Command, String> {
        let name = self.names[0];
        match &self.arguments {
            A::Nothing(command) if rest.is_empty() => Ok(command.clone()),
            A::Nothing(_) => Err(format!("{name} takes no arguments")),
            A::File(command) => Ok(command((!rest.is_empty()).then(|| PathBuf::from(rest)))),
            A::Name(command) => Ok(command((!rest.is_empty()).then(|| rest.to_owned()))),
            A::Language(command) => {
                match (rest, Language::of_extension(rest.trim_start_matches('.'))) {
                    ("", _) => Ok(command(None)),
                    (_, None) => Err(format!("{name} takes {}", extensions())),
                    (_, known) => Ok(command(known)),
                }
            }
            A::Pixels(command) => match Pixels::named(rest) {
                Some(pixels) => Ok(command(pixels)),
                None => Err(format!("{name} takes {}", Pixels::names())),
            },
            A::Picture(command) => ExportOrder::parse(rest).map(command),
            A::Said(_, parse) => parse(rest),
            A::Size(command) => {
                let size = Size::parse(rest);
                let size = size.ok_or_else(|| format!("{name} takes a size such as 800x600"))?;
                // The format with the highest limit.
                match ImageFormat::Ppm.refuses(size) {
                    None => Ok(command(size)),
                    Some(reason) => Err(reason),
                }
            }
        }
    }
}

/// Parses a command line; the error says what is expected.
fn parse(line: &str) -> Result<Command, String> {
    let line = line.trim();
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let called = |name: &str| TABLE.iter().find(|form| form.names.contains(&name));
    let (second, others) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    if let Some(form) = called(&format!("{name} {second}")) {
        return form.parse(others.trim());
    }
    if let Some(form) = called(name) {
        return form.parse(rest);
    }
    let names = TABLE.iter().map(|form| form.names[0]);
    let longer = names.filter(|longer| longer.split(' ').next() == Some(name));
    match longer.collect::<Vec<_>>().as_slice() {
        [] => Err(unknown(name)),
        longer => Err(format!("{}?", longer.join(", or "))),
    }
}

/// Parses the exposure of the display.
fn exposure(said: &str) -> Result<Command, String> {
    let half_stops = said.parse().ok().map(|stops: f64| 2.0 * stops);
    let is_known = |half_stops: &f64| {
        half_stops.fract() == 0.0 && half_stops.abs() <= f64::from(MOST_HALF_STOPS)
    };
    let most = MOST_HALF_STOPS / 2;
    let known = half_stops.filter(is_known);
    known
        .map(|half_stops| Command::Exposure(half_stops as i8))
        .ok_or_else(|| format!("exposure takes stops from -{most} to {most}, in steps of 0.5"))
}

/// Parses when a trace ends; nothing asks when it does.
fn until(said: &str) -> Result<Command, String> {
    let until = (!said.is_empty()).then(|| Until::parse(said));
    until.transpose().map(Command::Until)
}

fn unknown(name: &str) -> String {
    let names: Vec<_> = TABLE.iter().map(|form| form.names[0]).collect();
    match nearest_word(name, names.iter().copied()) {
        Some(nearest) => format!("unknown command `{name}`: did you mean {nearest}?"),
        None => format!(
            "unknown command `{name}`; the commands are {}",
            names.join(", ")
        ),
    }
}

impl App {
    /// The lines of the help page.
    pub fn help_lines(&self) -> Vec<HelpLine> {
        let search = self
            .overlays
            .help
            .as_ref()
            .map_or("", |help| help.search.value());
        let commands = TABLE.iter().map(|form| (form.usage(), form.words));
        self.keymap.help(search, self.mode, commands.collect())
    }

    /// The columns of the help page on a screen of this width.
    pub fn help_columns(&self, width: u16) -> Vec<Vec<HelpLine>> {
        let count = usize::from(width.saturating_sub(2) / HELP_COLUMN).clamp(1, MOST_COLUMNS);
        keymap::in_columns(self.help_lines(), count)
    }

    /// Runs a command line.
    pub(super) fn command(&mut self, line: &str) -> Vec<Effect> {
        if line.trim().is_empty() {
            return Vec::new();
        }
        match parse(line) {
            Ok(command) => self.run(command),
            Err(reason) => {
                self.overlays.fail(reason);
                Vec::new()
            }
        }
    }

    fn run(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Quit(Force::Yes)
            | Command::Mouse
            | Command::Theme(_)
            | Command::Pixels(_)
            | Command::Help => {}
            _ if self.mode == Mode::Move => {
                self.warn_of_transform();
                return Vec::new();
            }
            Command::Quit(Force::No) => {}
            _ if self.disk.is_opening() => {
                self.warn_of_opening();
                return Vec::new();
            }
            Command::Track(_)
            | Command::Compare(Some(_))
            | Command::Export(..)
            | Command::ExportCancel => {}
            _ => return self.outside_sequence(|app| app.perform(command)),
        }
        self.perform(command)
    }

    fn perform(&mut self, command: Command) -> Vec<Effect> {
        match command {
            Command::Write(file, force) => return self.write(file, force),
            Command::Quit(Force::No) => return self.quit(),
            Command::Quit(Force::Yes) => return self.quit_anyway(),
            Command::WriteQuit => return self.save_and_quit(),
            Command::Edit(None) => return self.reread(),
            Command::Edit(Some(path)) => return self.open_scene(path),
            Command::New(language) => {
                let language = language.unwrap_or_else(|| self.document.language());
                return self.leave_for(Next::New(language));
            }
            Command::Recent => return vec![Effect::ListRecent],
            Command::History => self.list_steps(),
            Command::Export(order, asking) => return self.export(order, asking),
            Command::ExportCancel => return self.cancel_export(),
            Command::Render => return self.start_trace(),
            Command::Compare(with) => return self.compare_with(with),
            Command::Track(file) => return self.open_track(file),
            Command::Until(until) => return self.trace_until(until),
            Command::Region(order) => return self.order_region(order),
            Command::Scale(order) => self.order_scale(order),
            Command::ViewSave(None) => self.save_view(),
            Command::ViewSave(Some(name)) => self.save_view_as(&name),
            Command::ViewLight => self.look_from_light(),
            Command::ViewReset => self.pictures.reset_view(),
            Command::Size(size) => self.set_size(size),
            Command::Set(order) => self.set_rendering(&order),
            Command::Mesh(file) => self.add_mesh(file.as_deref()),
            Command::Mouse => return self.toggle_mouse(),
            Command::Show(aov) => self.show(Some(aov)),
            Command::Exposure(half_stops) => self.set_exposure(half_stops),
            Command::Transfer(transfer) => self.set_transfer(transfer),
            Command::FalseColour => self.toggle_false_colours(),
            Command::Denoise => return self.toggle_denoising(),
            Command::Histogram => self.toggle_histogram(),
            Command::Theme(theme) => self.theme = theme,
            Command::Pixels(pixels) => self.pixels = pixels,
            Command::Help => self.overlays.help = Some(Help::default()),
        }
        Vec::new()
    }

    fn write(&mut self, file: Option<PathBuf>, force: Force) -> Vec<Effect> {
        let own = self.document.language();
        if let Some(path) = &file
            && Language::of_path(path) != Ok(own)
        {
            let extension = own.extension();
            let name = path.with_extension(extension);
            self.overlays
                .open_prompt_over(PromptKind::Command, &format!("w {}", name.display()));
            let shown = path.display();
            self.overlays
                .fail(format!("{shown}: the name must end in .{extension}"));
            // The path may not even name a file.
            return vec![Effect::CheckPlace(path.clone())];
        }
        match (file.or_else(|| self.disk.path.clone()), force) {
            (Some(path), Force::Yes) => self.save_to(&path, Guard::Anything),
            (Some(path), Force::No) if !self.disk.is_own(&path) => {
                if self.refuses_errors(&path) {
                    return Vec::new();
                }
                self.save_to(&path, Guard::Absent)
            }
            (_, Force::No | Force::Yes) => self.save(),
        }
    }

    fn set_size(&mut self, size: Size) {
        let Some(scene) = self.scene.clone().filter(|_| self.error_count() == 0) else {
            let words = "cannot set the size while the scene has errors";
            self.overlays.blame_errors(Severity::Error, words);
            return;
        };
        let camera = Camera {
            size,
            ..scene.camera
        };
        self.document.end_step();
        match self.write_camera(&camera, &scene.camera) {
            Ok(()) => {
                let Size { width, height } = size;
                let step = StepName::done(format!("set the size to {width}x{height}"));
                self.document.name_step(step);
            }
            Err(refused) => self.overlays.fail(refused.message),
        }
        self.document.end_step();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_in_the_readme() {
        let readme = include_str!("../../../README.md");
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let forms: Vec<_> = TABLE
            .iter()
            .map(|form| format!("`{}`", form.usage()))
            .collect();
        let list = format!("Commands: {}. ", forms.join(", "));
        assert!(words(readme).contains(&list), "{list}");
    }

    #[test]
    fn commands_are_found_by_every_name() {
        for (index, form) in TABLE.iter().enumerate() {
            for name in form.names {
                let argument = match form.arguments {
                    A::Size(_) => " 8x6",
                    A::Said(" STOPS", _) => " -1.5",
                    A::Said(" KEY [VALUE|default]", _) => " depth",
                    A::Pixels(_) => " half",
                    _ => "",
                };
                assert!(parse(&format!(" {name}{argument} ")).is_ok(), "{name}");
                let mut others = TABLE[..index].iter().flat_map(|form| form.names);
                assert!(others.all(|other| other != name), "{name}");
            }
        }
    }
}
