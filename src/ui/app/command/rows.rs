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

/// All commands, the most useful first.
#[rustfmt::skip]
pub(crate) const ROWS: &[CommandRow] = &[
    CommandRow::new(&["export"], FileAnd(PICTURE, |said| export(said, Asking::No)), "export the picture, in SEQUENCE all frames").also("screenshot image save png gif video movie picture jpg jpeg exr photo snapshot animation mp4 turntable output hdr tif tiff bmp ppm pfm still wallpaper thumbnail share print poster capture printscreen download").key("export").runs(OnTrack),
    CommandRow::new(&["render"], Nothing(|| Run::requests(trace::start)), "trace at full size").also("final quality high full best start raytrace").key("trace"),
    CommandRow::new(&["w", "write"], File(|file| Run::requests(|shared| files::write(shared, file, Force::No))), "save the scene, or save it as FILE").also("store keep write file as backup overwrite").key("save"),
    CommandRow::new(&["e", "edit", "reread"], File(|file| Run::requests(|shared| files::edit_file(shared, file))), "open FILE, or reload the scene's own").also("load file import other revert reload another scene browse"),
    CommandRow::new(&["compare"], File(compare), "compare with a picture or scene FILE, saved, or git [REVISION]").also("diff difference reference before after versus reference splitscreen baseline regression").key("compare").runs(OnTrack),
    CommandRow::new(&["size"], Said(" WxH", size), "set the picture size in the scene").also("resolution dimensions width height pixels aspect ratio hd 4k 1080p format"),
    CommandRow::new(&["set"], Said(" KEY [VALUE|default]", set), "write a render setting into the scene, by default the one in use").also("setting option depth samples integrator background threads filter antialiasing bounces quality configure preferences parameter gi faster speed sampling antialias aliasing jagged sky environment"),
    CommandRow::new(&["track"], File(|file| Run::within(|app| sequence::open_track(&mut app.sequence, &mut app.shared, file))), "play the track FILE, or the one beside the scene").also("animation turntable video movie timeline keyframes animate play frames loop clip film cinematic").key("track").runs(OnTrack),
    CommandRow::new(&["mesh"], File(|file| Run::does(move |shared| select::add_mesh(shared, file.as_deref()))), "add the mesh of an .obj, .ply or .stl FILE, named as from the scene").also("model import obj ply stl load geometry 3d triangles teapot blender triangle polygon asset"),
    CommandRow::new(&["new"], Said(" [LANGUAGE]", new), "start a new scene: ray, dat or xml").also("create blank empty start template file"),
    CommandRow::new(&["tutor"], Said(" [LESSON|skip|off]", tutor), "learn with your own hands: lessons edit, build, understand").also("tutorial lesson learn teach start course howto exercise beginner"),
    CommandRow::new(&["samples"], Nothing(|| Run::does(samples::list_samples)), "show the sample scenes as pictures").also("examples gallery demo templates"),
    CommandRow::new(&["recent"], Nothing(|| Run::requests(|_| vec![Effect::ListRecent])), "list recently used scenes").also("last opened files previous scenes"),
    CommandRow::new(&["history", "undolist"], Nothing(|| Run::does(history::list_steps)), "show the undo history as pictures").also("undo timeline past versions steps").key("history"),
    CommandRow::new(&["view save"], Name(|name| Run::does(|shared| camera::save_view_named(shared, name))), "write the view into the scene, or save it as NAME").also("camera store bookmark remember").key("write-view"),
    CommandRow::new(&["view light"], Nothing(|| Run::does(camera::look_from_light)), "look from the selected light").also("lamp"),
    CommandRow::new(&["view reset"], Nothing(|| Run::does(|shared| shared.pictures.reset_view())), "reset to the scene's view").also("camera default original home").key("reset-view"),
    CommandRow::new(&["exposure"], Said(" STOPS", exposure), "set the exposure of the display, in stops").also("brightness darkness ev stops bright dark lighten darken gain lighten luminosity overexposed underexposed"),
    CommandRow::new(&["denoise"], Nothing(|| Run::requests(display::toggle_denoising)), "reduce the noise of light on screen, or no longer").also("noise grain smooth clean noisy speckles fireflies blotchy artifacts").key("denoise"),
    CommandRow::new(&["zoom"], Said(" [fit|1:1|N]", zoom), "zoom the picture, also the preview").also("magnify scale enlarge"),
    CommandRow::new(&["region"], Said(" [X,Y,W,H|off]", region), "trace only these pixels at full size, or all").also("crop part area rectangle").key("region"),
    CommandRow::new(&["until"], Said(" [N spp|TIME|noise E]", until), "end the full-size trace at N spp, after 30 s or 5 min, or below noise 0.01").also("samples spp quality time noise limit stop iterations faster budget duration timeout"),
    CommandRow::new(&["histogram"], Nothing(|| Run::does(display::toggle_histogram)), "show or hide the histogram of the light").also("levels graph distribution clipping overexposed"),
    CommandRow::new(&["falsecolour", "falsecolor"], Nothing(|| Run::does(display::toggle_false_colours)), "display luminances as false colours, or no longer").also("heatmap luminance overexposed clipping"),
    CommandRow::new(&["transfer linear"], Nothing(|| Run::does(|shared| display::set_transfer(shared, Some(Transfer::Linear)))), "display light linearly").also("gamma tone mapping tonemapping curve colorspace"),
    CommandRow::new(&["transfer srgb"], Nothing(|| Run::does(|shared| display::set_transfer(shared, Some(Transfer::Srgb)))), "display light by the sRGB curve").also("gamma tone mapping tonemapping curve colorspace contrast"),
    CommandRow::new(&["transfer scene"], Nothing(|| Run::does(|shared| display::set_transfer(shared, None))), "display light as the scene says").also("gamma tone mapping default"),
    CommandRow::new(&["show uv"], Nothing(|| Run::does(|shared| display::show(shared, Some(Aov::Uv)))), "show texture coordinates: u red, v green").also("texture mapping coordinates unwrap"),
    CommandRow::new(&["show side"], Nothing(|| Run::does(|shared| display::show(shared, Some(Aov::Side)))), "show sides of surfaces: front blue, back orange").also("backface flipped normals inside"),
    CommandRow::new(&["theme dark"], Nothing(|| Run::does(|shared| shared.theme = Theme::Dark)), "use colours for dark screens").also("color colour scheme appearance black night").runs(Always),
    CommandRow::new(&["theme light"], Nothing(|| Run::does(|shared| shared.theme = Theme::Light)), "use colours for light screens").also("color colour scheme appearance white day").runs(Always),
    CommandRow::new(&["theme mono"], Nothing(|| Run::does(|shared| shared.theme = Theme::Mono)), "use no colours except in pictures").also("color colour scheme appearance grayscale black white monochrome").runs(Always),
    CommandRow::new(&["pixels"], Said(" MODE", pixels), "set what pixels are drawn with, such as half, octant or auto").also("blocks characters ascii sixel kitty braille glyphs resolution graphics unicode sharpness unicode blocky emoji").runs(Always),
    CommandRow::new(&["mouse"], Nothing(|| Run::requests(panels::toggle_mouse)), "take the mouse or leave it to the terminal").also("click pointer trackpad selection copy drag touchpad").runs(Always),
    CommandRow::new(&["follow"], Said(" typing|saving", follow), "follow the scene in an editor while typing, or when it is saved").also("live reload watch autosave editor sync").runs(Always),
    CommandRow::new(&["help"], Nothing(|| Run::does(|shared| shared.overlays.open_page(Page::reading(Context::Help)))), "show this page").also("manual documentation shortcuts keybindings guide").key("help").runs(Always),
    CommandRow::new(&["q", "quit"], Nothing(|| Run::requests(files::quit)), "quit").also("exit close leave end bye shutdown terminate logout bye").key("quit").runs(WhileOpening),
    CommandRow::new(&["wq", "x"], Nothing(|| Run::requests(files::save_and_quit)), "save and quit").also("exit store close"),
    CommandRow::new(&["w!", "write!"], File(|file| Run::requests(|shared| files::write(shared, file, Force::Yes))), "save, overwriting changes on disk").also("force overwrite"),
    CommandRow::new(&["q!", "quit!"], Nothing(|| Run::requests(files::quit_anyway)), "quit without asking").also("exit discard force abandon abort").runs(Always),
    CommandRow::new(&["export!"], FileAnd(PICTURE, |said| export(said, Asking::Forced)), "export, overwriting an existing file").also("force overwrite").runs(OnTrack),
    CommandRow::new(&["export cancel"], Nothing(|| Run::requests(exports::cancel_export)), "cancel the export").also("stop abort").key("stop").runs(OnTrack),
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
        None if app.compare.reference.is_none() => {
            compare::start(&mut app.compare, &mut app.shared)
        }
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
