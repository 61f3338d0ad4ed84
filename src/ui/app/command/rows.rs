//! The commands.

use std::path::PathBuf;

use super::row::{Arguments, CommandRow, Run, Runs};
use crate::app::display::ScaleOrder;
use crate::app::exports::ExportOrder;
use crate::app::files::Force;
use crate::app::pictures::region::RegionOrder;
use crate::app::pictures::until::Until;
use crate::app::shared::jobs::Asking;
use crate::app::text::SettingOrder;
use crate::app::{
    Page, camera, compare, display, exports, files, history, panels, samples, select, sequence,
    text, trace, tutor,
};
use crate::keymap::{Context, Mode};
use crate::msg::Effect;
use crate::pixels::Pixels;
use crate::theme::Theme;
use image_file::ImageFormat;
use language::{Language, extensions};
use link::Follow;
use render::{Aov, MOST_HALF_STOPS};
use scene::{Size, Transfer};

use Arguments::{File, FileAnd, Name, Nothing, Said};
use Runs::{Always, OnTrack, WhileOpening};

/// All commands, in the order of the help page.
#[rustfmt::skip]
pub(crate) const ROWS: &[CommandRow] = &[
    CommandRow::new(&["w", "write"], File(|file| Run::requests(|shared| files::write(shared, file, Force::No))), "save the scene, or save it as FILE").key("save"),
    CommandRow::new(&["w!", "write!"], File(|file| Run::requests(|shared| files::write(shared, file, Force::Yes))), "save, overwriting changes on disk"),
    CommandRow::new(&["q", "quit"], Nothing(|| Run::requests(files::quit)), "quit").also("exit").key("quit").runs(WhileOpening),
    CommandRow::new(&["q!", "quit!"], Nothing(|| Run::requests(files::quit_anyway)), "quit without asking").runs(Always),
    CommandRow::new(&["wq", "x"], Nothing(|| Run::requests(files::save_and_quit)), "save and quit"),
    CommandRow::new(&["e", "edit", "reread"], File(|file| Run::requests(|shared| files::edit_file(shared, file))), "open FILE, or reload the scene's own"),
    CommandRow::new(&["new"], Said(" [LANGUAGE]", new), "start a new scene: ray, dat or xml"),
    CommandRow::new(&["recent"], Nothing(|| Run::requests(|_| vec![Effect::ListRecent])), "list recently used scenes"),
    CommandRow::new(&["samples"], Nothing(|| Run::does(samples::list_samples)), "show the sample scenes as pictures").also("examples gallery demo templates"),
    CommandRow::new(&["tutor"], Said(" [LESSON|skip|off]", tutor), "learn with your own hands: lessons edit, build, understand").also("tutorial lesson learn teach start course howto"),
    CommandRow::new(&["history", "undolist"], Nothing(|| Run::does(history::list_steps)), "show the undo history as pictures").key("history"),
    CommandRow::new(&["export"], FileAnd(PICTURE, |said| export(said, Asking::No)), "export the picture, in SEQUENCE all frames").also("screenshot image save png gif video movie").key("export").runs(OnTrack),
    CommandRow::new(&["export!"], FileAnd(PICTURE, |said| export(said, Asking::Forced)), "export, overwriting an existing file").runs(OnTrack),
    CommandRow::new(&["export cancel"], Nothing(|| Run::requests(exports::cancel_export)), "cancel the export").key("stop").runs(OnTrack),
    CommandRow::new(&["render"], Nothing(|| Run::requests(trace::start)), "trace at full size").also("final quality").key("trace"),
    CommandRow::new(&["compare"], File(compare), "compare with a picture or scene FILE, saved, or git [REVISION]").key("compare").runs(OnTrack),
    CommandRow::new(&["until"], Said(" [N spp|TIME|noise E]", until), "end the full-size trace at N spp, after 30 s or 5 min, or below noise 0.01"),
    CommandRow::new(&["region"], Said(" [X,Y,W,H|off]", region), "trace only these pixels at full size, or all").key("region"),
    CommandRow::new(&["zoom"], Said(" [fit|1:1|N]", zoom), "zoom the picture, also the preview"),
    CommandRow::new(&["track"], File(|file| Run::within(|app| sequence::open_track(&mut app.sequence, &mut app.shared, file))), "play the track FILE, or the one beside the scene").also("animation turntable video movie timeline keyframes").key("track").runs(OnTrack),
    CommandRow::new(&["view save"], Name(|name| Run::does(|shared| camera::save_view_named(shared, name))), "write the view into the scene, or save it as NAME").key("write-view"),
    CommandRow::new(&["view light"], Nothing(|| Run::does(camera::look_from_light)), "look from the selected light"),
    CommandRow::new(&["view reset"], Nothing(|| Run::does(|shared| shared.pictures.reset_view())), "reset to the scene's view").key("reset-view"),
    CommandRow::new(&["size"], Said(" WxH", size), "set the picture size in the scene").also("resolution dimensions width height"),
    CommandRow::new(&["set"], Said(" KEY [VALUE|default]", set), "write a render setting into the scene, by default the one in use"),
    CommandRow::new(&["mesh"], File(|file| Run::does(move |shared| select::add_mesh(shared, file.as_deref()))), "add the mesh of an .obj, .ply or .stl FILE, named as from the scene").also("model import"),
    CommandRow::new(&["show uv"], Nothing(|| Run::does(|shared| display::show(shared, Some(Aov::Uv)))), "show texture coordinates: u red, v green"),
    CommandRow::new(&["show side"], Nothing(|| Run::does(|shared| display::show(shared, Some(Aov::Side)))), "show sides of surfaces: front blue, back orange"),
    CommandRow::new(&["exposure"], Said(" STOPS", exposure), "set the exposure of the display, in stops").also("brightness"),
    CommandRow::new(&["transfer linear"], Nothing(|| Run::does(|shared| display::set_transfer(shared, Some(Transfer::Linear)))), "display light linearly").also("gamma tone mapping"),
    CommandRow::new(&["transfer srgb"], Nothing(|| Run::does(|shared| display::set_transfer(shared, Some(Transfer::Srgb)))), "display light by the sRGB curve").also("gamma tone mapping"),
    CommandRow::new(&["transfer scene"], Nothing(|| Run::does(|shared| display::set_transfer(shared, None))), "display light as the scene says"),
    CommandRow::new(&["falsecolour", "falsecolor"], Nothing(|| Run::does(display::toggle_false_colours)), "display luminances as false colours, or no longer").also("heatmap"),
    CommandRow::new(&["denoise"], Nothing(|| Run::requests(display::toggle_denoising)), "reduce the noise of light on screen, or no longer").key("denoise"),
    CommandRow::new(&["histogram"], Nothing(|| Run::does(display::toggle_histogram)), "show or hide the histogram of the light"),
    CommandRow::new(&["mouse"], Nothing(|| Run::requests(panels::toggle_mouse)), "take the mouse or leave it to the terminal").runs(Always),
    CommandRow::new(&["theme dark"], Nothing(|| Run::does(|shared| shared.theme = Theme::Dark)), "use colours for dark screens").also("color scheme").runs(Always),
    CommandRow::new(&["theme light"], Nothing(|| Run::does(|shared| shared.theme = Theme::Light)), "use colours for light screens").also("color scheme").runs(Always),
    CommandRow::new(&["theme mono"], Nothing(|| Run::does(|shared| shared.theme = Theme::Mono)), "use no colours except in pictures").runs(Always),
    CommandRow::new(&["pixels"], Said(" MODE", pixels), "set what pixels are drawn with, such as half, octant or auto").runs(Always),
    CommandRow::new(&["follow"], Said(" typing|saving", follow), "follow the scene in an editor while typing, or when it is saved").runs(Always),
    CommandRow::new(&["help"], Nothing(|| Run::does(|shared| shared.overlays.open_page(Page::reading(Context::Help)))), "show this page").key("help").runs(Always),
];

const PICTURE: &str = " [FILE] [WxH] [SPP]";

fn tutor(said: &str) -> Result<Run, String> {
    let order = tutor::Order::parse(said)?;
    Ok(Run::within(move |app| {
        tutor::obey(&mut app.tutor, &mut app.shared, order)
    }))
}

fn new(said: &str) -> Result<Run, String> {
    let language = Language::of_extension(said.trim_start_matches('.'));
    if language.is_none() && !said.is_empty() {
        return Err(format!("new takes {}", extensions()));
    }
    Ok(Run::requests(move |shared| {
        files::start_new(shared, language)
    }))
}

/// Compares with the reference, or with another one once that is read. SEQUENCE is left when the comparison
/// starts.
fn compare(named: Option<PathBuf>) -> Run {
    Run::within(|app| match named {
        Some(named) => compare::read_reference(&mut app.compare, &mut app.shared, named),
        None => app.outside(|app| compare::start(&mut app.compare, &mut app.shared)),
    })
}

fn export(said: &str, asking: Asking) -> Result<Run, String> {
    let order = ExportOrder::parse(said)?;
    Ok(Run::within(move |app| {
        if app.shared.mode == Mode::Sequence {
            sequence::export(&app.sequence, &mut app.shared, order, asking)
        } else {
            exports::export(&mut app.shared, order, asking)
        }
    }))
}

/// Reads when a trace ends; nothing asks when it does.
fn until(said: &str) -> Result<Run, String> {
    let until = (!said.is_empty()).then(|| Until::parse(said)).transpose()?;
    Ok(Run::requests(move |shared| {
        trace::trace_until(shared, until)
    }))
}

fn region(said: &str) -> Result<Run, String> {
    let order = RegionOrder::parse(said)?;
    Ok(Run::requests(move |shared| {
        trace::order_region(shared, order)
    }))
}

fn zoom(said: &str) -> Result<Run, String> {
    let order = ScaleOrder::parse(said)?;
    Ok(Run::does(move |shared| display::order_scale(shared, order)))
}

fn follow(said: &str) -> Result<Run, String> {
    let follow = Follow::named(said).ok_or(":follow needs typing or saving")?;
    Ok(Run::requests(move |_| vec![Effect::FollowBuffers(follow)]))
}

fn size(said: &str) -> Result<Run, String> {
    let size = Size::parse(said).ok_or(":size needs WIDTHxHEIGHT, such as 800x600")?;
    // The format with the highest limit.
    match ImageFormat::Ppm.refuses(size) {
        None => Ok(Run::does(move |shared| text::set_size(shared, size))),
        Some(reason) => Err(reason),
    }
}

fn set(said: &str) -> Result<Run, String> {
    let order = SettingOrder::parse(said)?;
    Ok(Run::does(move |shared| text::set_rendering(shared, &order)))
}

/// Reads the exposure of the display.
fn exposure(said: &str) -> Result<Run, String> {
    let half_stops = said.parse().ok().map(|stops: f64| 2.0 * stops);
    let is_known = |half_stops: &f64| {
        half_stops.fract() == 0.0 && half_stops.abs() <= f64::from(MOST_HALF_STOPS)
    };
    let half_stops = half_stops.filter(is_known).ok_or_else(|| {
        let most = MOST_HALF_STOPS / 2;
        format!(":exposure needs EV from -{most} to {most}, in steps of 0.5")
    })?;
    Ok(Run::does(move |shared| {
        display::set_exposure(shared, half_stops as i8);
    }))
}

fn pixels(said: &str) -> Result<Run, String> {
    let pixels = Pixels::named(said);
    let pixels =
        pixels.ok_or_else(|| format!("no pixel mode `{said}`; modes: {}", Pixels::names()))?;
    Ok(Run::does(move |shared| shared.pixels = pixels))
}
