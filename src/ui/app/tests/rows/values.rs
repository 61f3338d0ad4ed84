//! What can be seen by a name. What is absent, and `false`, reads as an empty text.

use super::*;
use crate::document::StepName;
use crate::language::Node;
use crate::render::Aov;
use crate::scene::Camera;
use crate::ui::app::{command, compare, display, files, inspect, select, text};
use crate::ui::keymap::Context;
use crate::ui::listing::ListLine;

/// Something in words.
pub(super) trait Words {
    fn words(self) -> String;
}

impl Words for bool {
    fn words(self) -> String {
        if self { "yes" } else { "" }.to_owned()
    }
}

impl<T: ToString> Words for Option<T> {
    fn words(self) -> String {
        self.map_or_else(String::new, |it| it.to_string())
    }
}

/// What is seen under a name, if there is something of this name.
pub(super) fn seen(app: &App, name: &str) -> Option<String> {
    let rooms = [text, settings, overlays, camera, pictures, comparison, work];
    rooms.iter().find_map(|room| room(app, name))
}

/// What is edited, and the cursor in it.
fn text(app: &App, name: &str) -> Option<String> {
    let typing = app.shared.cursor.typing.as_ref();
    let refused = typing.and_then(|typing| typing.refused.as_ref());
    let past = app
        .shared
        .document
        .states()
        .take(app.shared.document.present() + 1);
    let steps = past.filter_map(|state| state.name.map(StepName::to_string));
    Some(match name {
        "text" => app.shared.document.text().to_owned(),
        "dirty" => app.shared.document.is_dirty().words(),
        "language" => app.shared.document.language().extension().to_owned(),
        "undoable" => app.shared.document.undoable().words(),
        "steps" => joined(steps, "; "),
        "step" => app.shared.document.present().to_string(),
        "errors" => count(app.shared.error_count()),
        "reported" => count(app.shared.reported.len()),
        "wrong" => findings(app),
        "at" => app.shared.cursor.selected().to_string(),
        "named" => app.shared.source().name(app.shared.cursor.selected()),
        "field" => app.shared.cursor.field.to_string(),
        "typed" => typing.map(|typing| typing.input.value()).words(),
        "refused" => refused.map(|refused| &refused.message).words(),
        "expected" => refused.map(|refused| &refused.expected).words(),
        "parts" => {
            let parts = app.shared.cursor.parts().iter();
            joined(parts.map(|(depth, node)| format!("{depth} {node}")), ", ")
        }
        "inputs" => text::has_input(&app.shared).words(),
        "marks" => count(app.shared.cursor.marks.len()),
        "nodes" => count(app.shared.nodes().len()),
        "list" => list(app),
        "views" => joined(
            app.shared
                .source()
                .saved_views()
                .into_iter()
                .map(|view| view.name),
            ", ",
        ),
        "objects" => app
            .shared
            .scene
            .as_ref()
            .map(|scene| scene.objects.len())
            .words(),
        _ => return None,
    })
}

/// Settings of pictures, and what is on screen.
fn settings(app: &App, name: &str) -> Option<String> {
    let output = app.shared.output();
    Some(match name {
        "mode" => app.shared.mode.name().to_owned(),
        "context" => format!("{:?}", app.shared.context()),
        "size" => format!("{}x{}", output.width, output.height),
        "integrator" => app.shared.rendering().integrator().name().to_owned(),
        "overridden" => app.shared.is_integrator_changed().words(),
        "rendering" => format!("{:?}", app.shared.rendering()),
        "aov" => app.shared.pictures.aov.map(Aov::name).words(),
        "region" => app.shared.pictures.region.is_some().words(),
        "exposure" => display::display_name(&app.shared).words(),
        "exposed" => {
            let window = display::frame_window(&app.shared);
            window
                .map(|window| window.display.half_stops.to_string())
                .words()
        }
        "transforms" => app.moving.is_some().words(),
        "denoised" => {
            let window = display::frame_window(&app.shared);
            window.is_some_and(|window| window.display.denoised).words()
        }
        "view-name" => display::view_name(&app.shared).words(),
        "legend" => display::legend(&app.shared).words(),
        "theme" => format!("{:?}", app.shared.theme),
        "panel" => app.shared.areas().border.x.to_string(),
        "hints" => {
            let hints = app.hints().into_iter();
            ended(hints.map(|(key, words)| format!("{key} {words}")), ", ")
        }
        "answers" => app.hints().into_iter().map(|(key, _)| key).collect(),
        _ => return None,
    })
}

/// Messages, questions, prompts, menus and pages.
fn overlays(app: &App, name: &str) -> Option<String> {
    let overlays = &app.shared.overlays;
    let (menu, help) = (overlays.menu.as_ref(), overlays.page(Context::Help));
    let past = overlays.messages.past().map(|message| &message.text);
    let failed = overlays.message.as_ref().filter(|_| overlays.has_failed());
    let prompt = overlays.prompt.as_ref();
    let entries = menu.map(|menu| menu.shown()).unwrap_or_default();
    Some(match name {
        "says" => words(app).to_owned(),
        "shown" => shown(app).to_owned(),
        "past" => joined(past, "; "),
        "fault" => failed.map(|message| &message.text).words(),
        "asks" => question(app),
        "loses" => files::losses(&app.shared).words(),
        "prompt" => prompt
            .map(|prompt| format!(":{}", prompt.input.value()))
            .words(),
        "completed" => {
            let found = command::completions(&app.shared).into_iter();
            ended(
                found.map(|found| format!("{} [{}]", found.shown, found.keys)),
                "; ",
            )
        }
        "menu" => menu.is_some().words(),
        "offers" => joined(entries.iter().map(|entry| &entry.name), ", "),
        "offered" => entries.last().map(|entry| &entry.words).words(),
        "help" => help.is_some().words(),
        "help-top" => help.map(|help| help.filter.at).words(),
        "search" => help.map(|help| help.filter.input.value()).words(),
        "history" => overlays
            .page(Context::Messages)
            .map(|past| past.filter.at)
            .words(),
        "page" => overlays.page.is_some().words(),
        "listed-error" => overlays.errors.words(),
        _ => return None,
    })
}

/// The working view: `camera` in full, `stands` and `target` exactly, and `view` rounded.
fn camera(app: &App, name: &str) -> Option<String> {
    let camera = app.shared.camera();
    Some(match name {
        "camera" => format!("{camera:?}"),
        "stands" => camera
            .map(|camera| format!("{} {}", camera.eye, camera.up))
            .words(),
        "target" => camera.map(|camera| camera.target).words(),
        "view" => camera.map(|camera| rounded(&camera)).words(),
        "moved" => app.shared.pictures.view.is_some().words(),
        _ => return None,
    })
}

/// The pictures, and what is over them.
fn pictures(app: &App, name: &str) -> Option<String> {
    let latest = app.shared.picture().latest.as_ref();
    Some(match name {
        "picture" => latest.is_some().words(),
        "first" => latest.map(|frame| frame.pixels[0][0]).words(),
        "awaited" => app.shared.picture().wanted.is_some().words(),
        "paused" => app.shared.picture().paused.words(),
        "traced" => app.shared.pictures.trace.is_some().words(),
        "corner" => app.shared.pictures.preview.shown.object_at(0, 0).words(),
        "under" => match inspect::node_at(&app.shared, [0, 0]) {
            Ok(node) => node.words(),
            Err(_) => "unknown".to_owned(),
        },
        "compared-at" => {
            let cross = app.compare.cross;
            cross.map(|(x, y)| format!("{x},{y}")).words()
        }
        "cross" => inspect::cross(&app.shared)
            .map(|cross| joined(cross.pixel, ","))
            .words(),
        "outlined" => joined(display::outlined_objects(&app.shared), " "),
        "symbols" => joined(
            display::symbols(&app.shared)
                .iter()
                .map(|symbol| symbol.node),
            ", ",
        ),
        "solo" => app.shared.pictures.solo.is_some().words(),
        "thumbnails" => app.thumbnails.are_awaited().words(),
        _ => return None,
    })
}

/// The comparison with a reference.
fn comparison(app: &App, name: &str) -> Option<String> {
    let compared = &app.compare;
    Some(match name {
        "contrast" => compared.view.name().into_owned(),
        "figures" => compared.are_figures_final().words(),
        "differing" => compared.figures().map(|found| found.differing).words(),
        "reference" => compared.reference.as_ref().map(|found| &found.name).words(),
        "comparing" => compared.is_awaited().words(),
        "unlike" => compare::unlike(&app.compare, &app.shared).words(),
        _ => return None,
    })
}

/// Files, saves, exports and the track.
fn work(app: &App, name: &str) -> Option<String> {
    let export = app.shared.jobs.export.as_ref();
    let track = app.sequence.open.as_ref();
    let writing = app.shared.jobs.still_writing();
    Some(match name {
        "disk" => {
            let state = format!("{:?}", app.shared.disk.state).to_lowercase();
            state.split('(').next().map(str::to_owned).words()
        }
        "path" => app
            .shared
            .disk
            .path
            .as_ref()
            .map(|path| path.display())
            .words(),
        "polls" => files::polls(&app.shared).words(),
        "unkept" => files::fails_to_keep(&app.shared).words(),
        "awaits" => app.shared.assets.are_awaited().words(),
        "opening" => app.shared.disk.is_opening().words(),
        "leaving" => app.shared.jobs.next.is_some().words(),
        "writing" => writing
            .map(|(path, time)| format!("{} {time}", path.display()))
            .words(),
        "exporting" => export
            .map(|export| export.destination.path.display())
            .words(),
        "done" => export.map(Export::done).words(),
        "queued" => count(app.shared.jobs.queued()),
        "frame" => track.map(|open| open.frame).words(),
        "plays" => track.is_some_and(|open| open.is_playing).words(),
        "held" => track.and_then(|open| open.held.as_ref()).words(),
        _ => return None,
    })
}

/// What is found wrong, and where.
fn findings(app: &App) -> String {
    let wrong = app.shared.wrong();
    let found = wrong.findings.iter().map(|found| {
        let place = found.span.of(wrong.text);
        format!("{} at {place}", found.message_with_file())
    });
    joined(found, ", ")
}

/// The question that is open; of a conflict the base, mine and theirs of each place, and the
/// decision.
fn question(app: &App) -> String {
    match &app.shared.overlays.dialog {
        None => String::new(),
        Some(Dialog::Leave(AfterLeaving::Quit)) => "quit".to_owned(),
        Some(Dialog::Leave(AfterLeaving::Open(path))) => format!("open {}", path.display()),
        Some(Dialog::Leave(AfterLeaving::New(_))) => "new".to_owned(),
        Some(Dialog::Conflict { merge, .. }) => {
            let each = merge.conflicts.iter().map(|conflict| {
                let [base, mine, theirs] =
                    [&conflict.base, &conflict.mine, &conflict.theirs].map(|text| text.trim());
                let decision = conflict.decision.map(|side| format!(": {side:?}")).words();
                format!("{base} {mine} {theirs}{decision}")
            });
            format!("conflict {}", joined(each, ", "))
        }
        Some(Dialog::Delete(nodes)) => {
            format!(
                "delete: {}",
                select::question_before_deleting(&app.shared, nodes).text
            )
        }
        Some(Dialog::Overwrite(_)) => "overwrite".to_owned(),
        Some(Dialog::Recover(offer)) => {
            format!("recover {} {}", offer.places, offer.conflicts())
        }
    }
}

/// A count, nothing for none.
fn count(count: usize) -> String {
    match count {
        0 => String::new(),
        count => count.to_string(),
    }
}

fn ended(items: impl Iterator<Item = String>, end: &str) -> String {
    items.fold(String::new(), |all, item| all + &item + end)
}

pub(super) fn joined<T: ToString>(items: impl IntoIterator<Item = T>, between: &str) -> String {
    let items = items.into_iter().map(|item| item.to_string());
    items.collect::<Vec<_>>().join(between)
}

/// A camera with numbers of at most four decimals.
fn rounded(camera: &Camera) -> String {
    let parts = [
        ("eye", camera.eye),
        ("target", camera.target),
        ("up", camera.up),
    ];
    let parts = parts.map(|(name, at)| {
        // Without a sign of zero.
        let at = at
            .to_array()
            .map(|number| (number * 1e4).round() / 1e4 + 0.0);
        format!("{name} {}", joined(at, " "))
    });
    parts.join(" ")
}

/// The list's nodes with their marks: of selection and of folded groups, with a comma between them.
fn list(app: &App) -> String {
    let lines = (0..app.shared.listing().len()).filter_map(|line| app.shared.listing().get(line));
    let nodes = lines.filter_map(|line| match line {
        ListLine::Heading(_) => None,
        ListLine::Node(_, node) => Some(node),
    });
    let marked = nodes.map(|node| {
        let is_folded = matches!(node, Node::Object(at) if app.shared.cursor.rows.is_folded(at));
        let fold = if is_folded { "+" } else { "" };
        let is_selected = node == app.shared.cursor.selected();
        let cursor = if is_selected { ">" } else { "" };
        format!("{cursor}{fold}{}", app.shared.source().name(node))
    });
    joined(marked, ", ")
}
