//! Pinning and loading references, and comparing with them.

use std::sync::Arc;

use super::pictures::frame;
use super::*;
use crate::compare::Comparison;
use crate::render::{Aov, Frame, Frames, Job, Record};
use crate::scene::{Image, Images, Integrator, Size, Viewpoint};
use crate::ui::msg::Target;
use crate::ui::reference::{Made, Pair, ReferenceId, ReferenceRead, ReferenceSource};

/// A frame of one colour, except for its first pixel.
fn picture(size: Size, generation: u64, first: [u8; 3]) -> Arc<Frame> {
    let mut frame = frame(size, vec![0; size.pixels()]);
    frame.generation = generation;
    frame.progress.spp = 16;
    frame.pixels[0] = first;
    Arc::new(frame)
}

/// The interface where no option asks for a render setting.
fn unasked() -> App {
    let opening = opening_as("scene.ray", SCENE.to_owned());
    let (app, _) = App::open(Opening {
        rendering: Rendering::default(),
        ..opening
    });
    app
}

/// The interface with a complete preview.
fn previewed() -> (App, Size) {
    let mut app = open(SCENE);
    let screen = app.preview_screen().expect("there is room");
    let size = screen.grid.size(screen.halves);
    app.update(Msg::Started(Target::Preview, 1));
    app.update(Msg::Frame(Target::Preview, picture(size, 1, [9; 3])));
    (app, size)
}

fn job(effects: &[Effect], wanted: Target) -> Option<&Job> {
    effects.iter().find_map(|effect| match effect {
        Effect::Trace(target, job) if *target == wanted => Some(job),
        _ => None,
    })
}

fn pair(effects: &[Effect]) -> Option<Pair> {
    effects.iter().find_map(|effect| match effect {
        Effect::Compare(pair) => Some(pair.clone()),
        _ => None,
    })
}

/// Delivers the picture that is compared, and its figures.
fn compare(app: &mut App, live: Arc<Frame>) -> Pair {
    app.update(Msg::Started(Target::Compared, live.generation));
    let effects = app.update(Msg::Frame(Target::Compared, live));
    let pair = pair(&effects).expect("they are measured");
    let found = pair.compare().expect("equal sizes");
    app.update(Msg::Compared(pair.clone(), Some(Arc::new(found))));
    pair
}

fn seen(app: &App) -> [u8; 3] {
    app.picture().latest.as_ref().expect("a frame").pixels[0]
}

#[test]
fn the_present_picture_is_traced_as_the_pinned_one_was_and_looked_at() {
    let (mut app, size) = previewed();
    press(&mut app, "A");
    assert!(
        words(&app).starts_with("pinned the preview, light, 16 spp"),
        "{}",
        words(&app)
    );
    let effects = press(&mut app, "=");
    let live = job(&effects, Target::Compared).expect("it is traced");
    assert_eq!((live.settings.size, live.settings.spp), (size, 16));
    assert_eq!(app.mode, Mode::Compare);
    let pair = compare(&mut app, picture(size, 7, [29; 3]));
    let image = |frame: &Frame| Image::new(size, frame.pixels.clone()).expect("it has pixels");
    let expected = Comparison::of(&image(&pair.live), &image(&pair.reference), 0);
    assert_eq!(app.compared.figures(), expected.as_ref().ok());
    assert!(app.compared.are_figures_final());
    for (keys, view, first) in [
        ("", "live", 29),
        ("f", "reference", 9),
        ("f", "live", 29),
        ("w", "wipe", 29),
        ("d", "difference", 20),
        ("d", "difference ×4", 80),
        ("d", "difference ×16", 255),
        ("d", "heat map", 251),
        ("d", "difference", 20),
        ("h", "wipe", 29),
    ] {
        press(&mut app, keys);
        assert_eq!(app.compared.view.name(), view, "{keys}");
        assert_eq!(seen(&app)[0], first, "{keys} {view}");
    }
    let width = app.raster().expect("there is room").0.width;
    for _ in 0..width {
        press(&mut app, "h");
    }
    assert_eq!((app.compared.wipe.0, seen(&app)[0]), (0.0, 9));
    press(&mut app, "n");
    assert_eq!(app.compared.cross, Some((0, 0)));
    let effects = press(&mut app, "<Esc>");
    assert_eq!(app.mode, Mode::Select);
    for target in [Target::Compared, Target::Reference] {
        let stops = |effect: &Effect| matches!(effect, Effect::Stop(of) if *of == target);
        assert!(effects.iter().any(stops), "{target:?}");
    }
}

#[test]
fn a_pixel_is_explained_in_the_present_picture_and_the_comparison_goes_on() {
    let (mut app, size) = previewed();
    press(&mut app, "A=");
    let live = picture(size, 7, [29; 3]);
    compare(&mut app, Arc::clone(&live));
    let effects = press(&mut app, "fe");
    assert_eq!((app.mode, app.seen()), (Mode::Inspect, Target::Compared));
    let explained = effects.iter().find_map(|effect| match effect {
        Effect::Explain(question, frame) => Some((question.pixel, frame)),
        _ => None,
    });
    let (pixel, frame) = explained.expect("it is asked for");
    assert_eq!(pixel, [0, 0]);
    assert!(Arc::ptr_eq(frame, &live));
    press(&mut app, "<Esc><Esc>");
    assert_eq!(app.mode, Mode::Compare);
    assert_eq!(seen(&app), [9; 3]);
}

#[test]
fn an_undone_edit_is_traced_again_and_its_old_figures_are_not_final() {
    let (mut app, size) = previewed();
    press(&mut app, "A");
    press(&mut app, TO_FIRST_OBJECT);
    press(&mut app, "el<Esc>=");
    compare(&mut app, picture(size, 7, [29; 3]));
    let effects = press(&mut app, "u");
    assert!(job(&effects, Target::Compared).is_some());
    app.update(Msg::Started(Target::Compared, 8));
    assert!(!app.compared.are_figures_final());
    compare(&mut app, picture(size, 8, [9; 3]));
    assert!(app.compared.are_figures_final());
    assert_eq!(app.compared.figures().map(|found| found.differing), Some(0));
    press(&mut app, "n");
    assert_eq!(words(&app), "no pixel differs");
}

#[test]
fn what_cannot_be_compared_is_refused_with_a_reason() {
    let nothing = "nothing to compare with: A pins the picture, :compare FILE loads one";
    for (keys, reason) in [
        ("=", nothing),
        (":compare<Enter>", nothing),
        ("A", "cannot pin the picture: it is still being traced"),
        ("6A", "a wireframe cannot be pinned: 1 shows a picture"),
        (":compare git --help<Enter>", "--help is not a revision"),
    ] {
        let mut app = open(SCENE);
        let effects = press(&mut app, keys);
        assert!(!wants(&effects, |effect| matches!(
            effect,
            Effect::ReadReference(..)
        )));
        assert_eq!(words(&app), reason, "{keys}");
        assert_eq!(app.mode, Mode::Select);
    }
    let (mut app, _) = opened_as("scene.ray", SCENE);
    app.disk.path = None;
    for keys in [":compare saved<Enter>", ":compare HEAD<Enter>"] {
        press(&mut app, keys);
        assert_eq!(words(&app), "the scene has no file yet: :w FILE");
    }
}

#[test]
fn the_command_names_files_the_saved_scene_and_revisions() {
    let own = || PathBuf::from("scene.ray");
    let revision = |name: &str| ReferenceSource::Revision(name.to_owned(), own());
    for (typed, expected) in [
        ("theirs x.ppm", ReferenceSource::File("theirs x.ppm".into())),
        ("./saved", ReferenceSource::File("./saved".into())),
        ("saved", ReferenceSource::File(own())),
        ("git", revision("HEAD")),
        ("HEAD", revision("HEAD")),
        ("HEAD~3", revision("HEAD~3")),
        ("git v1.0", revision("v1.0")),
    ] {
        let mut app = open(SCENE);
        let effects = press(&mut app, &format!(":compare {typed}<Enter>"));
        let read = effects.iter().find_map(|effect| match effect {
            Effect::ReadReference(_, source) => Some(source.clone()),
            _ => None,
        });
        assert_eq!(read, Some(expected), "{typed}");
    }
}

/// The effects of a picture of this size that was read, with what its file says of it.
fn read_picture(app: &mut App, [width, height]: [u32; 2], record: Option<&str>) -> Vec<Effect> {
    press(app, ":compare theirs.png<Enter>");
    let size = Size { width, height };
    let frame = Frame::drawn(size, vec![[0; 3]; size.pixels()]);
    let made = Made {
        record: record.map(|text| Box::new(Record::read(text))),
        holds_light: false,
    };
    let read = ReferenceRead::Picture(Arc::new(frame), made);
    let id = app.compared.requested();
    app.update(Msg::ReferenceRead(id, Ok(read)))
}

#[test]
fn the_scene_is_traced_at_the_size_of_a_picture() {
    let mut app = unasked();
    let Size { width, height } = app.output();
    for size in [[width / 2, height / 2], [64, 64]] {
        let mut app = unasked();
        let effects = read_picture(&mut app, size, None);
        let live = job(&effects, Target::Compared).expect("it is traced");
        let [width_of, height_of] = size;
        let traced = Size {
            width: width_of,
            height: height_of,
        };
        assert_eq!((live.settings.size, live.camera.size), (traced, traced));
        assert_eq!(app.mode, Mode::Compare);
        assert_eq!(
            words(&app),
            format!(
                "theirs.png records no settings: traced at {width_of}×{height_of}, 16 spp, \
                 whitted, depth 8; the scene's own size is {width}×{height}"
            )
        );
        let (cells, halves) = app.raster().expect("there is room");
        let [shown, own] =
            [halves, traced].map(|size| f64::from(size.width) / f64::from(size.height));
        assert!((shown / own - 1.0).abs() < 0.1, "{cells:?} {halves:?}");
    }
    // A pinned one as well, once the scene's size is another.
    press(&mut app, "<F5>");
    app.update(Msg::Started(Target::Trace, 1));
    let size = app.output();
    app.update(Msg::Frame(Target::Trace, picture(size, 1, [9; 3])));
    press(&mut app, "A<Esc>:size 64x64<Enter>");
    let effects = press(&mut app, "=");
    let live = job(&effects, Target::Compared).expect("it is traced");
    assert_eq!(live.settings.size, size);
    let said = format!(
        "traced at {width}×{height}, the size of the pinned picture; the scene's own is 64×64"
    );
    assert!(said_before(&app, &said), "{}", words(&app));
}

/// Whether this was said in the session.
fn said_before(app: &App, said: &str) -> bool {
    app.overlays
        .messages
        .past()
        .any(|message| message.text == said)
}

const RECORD: &str = "version 1\nscene 0\nview fov 30\nlayers none\ndenoise yes\nsize 8x6\n\
                      region 1,2,3,4\ndepth 2\nseed 7\naov none\nintegrator path\nfilter gaussian\n\
                      transfer srgb\nexposure -1\nfalloff square\nnoise 0.05\nclamp 8\n\
                      gloss exponent\nspp 64\n";

#[test]
fn a_picture_is_compared_as_its_file_says_that_it_was_made() {
    let mut app = unasked();
    // Neither the text's settings nor the moved view count.
    press(&mut app, "vl<Esc>");
    let effects = read_picture(&mut app, [3, 4], Some(RECORD));
    let live = job(&effects, Target::Compared).expect("it is traced");
    let mut written = live.settings.written();
    written.push(("spp", live.settings.spp.to_string()));
    for (name, value) in written {
        let line = format!("{name} {value}\n");
        assert!(RECORD.contains(&line), "{line}");
    }
    let own = app.scene.as_ref().expect("a scene").camera;
    let view = Viewpoint::between(&own, &live.camera).to_string();
    assert_eq!(view, "fov 30");
    assert!(live.denoise && live.frames == Frames::LastWithValues);
    let said = "traced as recorded in theirs.png: its view, 8×6, 64 spp, path, depth 2, region \
                1,2,3,4, seed 7, filter gaussian, transfer srgb, exposure -1, falloff square, noise \
                0.05, clamp 8, gloss exponent, denoised; the scene's own size is ";
    assert!(words(&app).starts_with(said), "{}", words(&app));
    // What the user chooses comes first, and an AOV is named as unlike.
    press(&mut app, "PP");
    let effects = press(&mut app, "2");
    let live = job(&effects, Target::Compared).expect("it is traced");
    assert_eq!(live.settings.integrator, Integrator::Photon);
    assert_eq!(live.settings.spp, 1);
    let unlike = app.compares_unlike();
    assert_eq!(unlike.as_deref(), Some("depth against light"));
}

#[test]
fn of_a_record_that_cannot_be_believed_the_rest_is_used() {
    for (record, settings) in [
        (
            "spp 0\ndepth 3\nnew 1\n",
            "16 spp, whitted, depth 3; ignored: spp 0, new 1, version is missing and 13 more",
        ),
        ("nonsense", "16 spp, whitted, depth 8; ignored: nonsense"),
    ] {
        let mut app = unasked();
        let Size { width, height } = app.output();
        read_picture(&mut app, [width, height], Some(record));
        let expected = format!("traced as recorded in theirs.png: {width}×{height}, {settings}");
        assert_eq!(words(&app), expected);
    }
}

/// A pinned picture stays whatever becomes of another one.
#[test]
fn a_reference_that_cannot_be_compared_leaves_the_one_before() {
    let (mut app, _) = previewed();
    press(&mut app, "A");
    let name = |app: &App| {
        app.compared
            .reference
            .as_ref()
            .map(|reference| reference.name.clone())
    };
    let pinned = name(&app).expect("it is pinned");
    // Its whole picture would have too many pixels to trace.
    let huge = RECORD.replace("size 8x6", "size 4294967295x6");
    let effects = read_picture(&mut app, [3, 4], Some(&huge));
    assert!(wants(&effects, |effect| matches!(effect, Effect::Free(_))));
    assert_eq!(name(&app), Some(pinned.clone()));
    press(&mut app, ":compare none.png<Enter>");
    let id = app.compared.requested();
    app.update(Msg::ReferenceRead(
        id,
        Err("none.png: no such file".to_owned()),
    ));
    assert_eq!((name(&app), app.mode), (Some(pinned), Mode::Select));
    press(&mut app, "=");
    assert_eq!(app.mode, Mode::Compare);
}

#[test]
fn a_scene_is_traced_with_the_same_settings_and_edits_of_the_present_one_are_not_in_it() {
    let mut app = open(SCENE);
    press(&mut app, ":compare saved<Enter>");
    let other = Arc::clone(app.scene.as_ref().expect("a scene"));
    let read = ReferenceRead::Scene(Arc::clone(&other), Images::default());
    press(&mut app, TO_FIRST_OBJECT);
    press(&mut app, "el<Esc>");
    let effects = app.update(Msg::ReferenceRead(ReferenceId(1), Ok(read)));
    let live = job(&effects, Target::Compared).expect("it is traced");
    let reference = job(&effects, Target::Reference).expect("it is traced");
    assert!(Arc::ptr_eq(&reference.scene, &other));
    assert_ne!(live.scene, reference.scene);
    assert_eq!(live.settings, reference.settings);
    let size = live.settings.size;
    app.update(Msg::Started(Target::Compared, 3));
    app.update(Msg::Started(Target::Reference, 4));
    app.update(Msg::Frame(Target::Compared, picture(size, 3, [29; 3])));
    assert!(app.compared.is_awaited());
    let effects = app.update(Msg::Frame(Target::Reference, picture(size, 4, [9; 3])));
    assert!(pair(&effects).is_some() && !app.compared.is_awaited());
    press(&mut app, "f");
    assert_eq!(seen(&app), [9; 3]);
}

#[test]
fn different_channels_are_named() {
    let (mut app, size) = previewed();
    press(&mut app, "A=2");
    compare(&mut app, picture(size, 7, [29; 3]));
    assert_eq!(app.pictures.aov, Some(Aov::Depth));
    let unlike = app.compares_unlike();
    assert_eq!(unlike.as_deref(), Some("depth against light"));
    press(&mut app, "1");
    assert_eq!(app.compares_unlike(), None);
}

#[test]
fn the_comparison_leads_back_to_the_mode_before_it() {
    for (keys, mode) in [
        ("=<Esc>", Mode::Select),
        ("==", Mode::Select),
        ("v:compare<Enter><Esc>", Mode::View),
        ("e=<Esc>", Mode::Edit),
        ("<F5>=", Mode::Compare),
        ("<F5>=<Esc>", Mode::Trace),
        ("<F5>=<Esc><Esc>", Mode::Select),
        ("=<F5><Esc>", Mode::Select),
        ("<F5>=<F5><Esc>", Mode::Select),
    ] {
        let (mut app, _) = previewed();
        press(&mut app, "A");
        press(&mut app, keys);
        assert_eq!(app.mode, mode, "{keys}");
    }
}

#[test]
fn a_late_or_failed_reference_changes_nothing() {
    let mut app = open(SCENE);
    press(&mut app, ":compare a.ppm<Enter>:compare b.ppm<Enter>");
    let late = Err("cannot be read".to_owned());
    let effects = app.update(Msg::ReferenceRead(ReferenceId(1), late.clone()));
    assert!(wants(&effects, |effect| matches!(effect, Effect::Free(_))));
    assert_eq!(words(&app), "");
    app.update(Msg::ReferenceRead(ReferenceId(2), late));
    assert_eq!(words(&app), "cannot be read");
    assert!(app.compared.reference.is_none());
}
