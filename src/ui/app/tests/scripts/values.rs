//! What can be seen by a name. What is absent, and `false`, reads as an empty text.

use super::*;
use crate::app::{command, compare, display, files, history, inspect, select, tutor};
use crate::keymap::Context;
use crate::listing::ListLine;
use document::StepName;
use language::Node;
use render::{Aov, Histogram};
use scene::Camera;

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
    let rooms = [
        text, settings, overlays, camera, pictures, zoom, rays, comparison, work,
    ];
    rooms.iter().find_map(|room| room(app, name))
}

/// What is edited, and the cursor in it.
fn text(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let (typing, scene) = (shared.cursor.typing.as_ref(), shared.scene.as_ref());
    let refused = typing.and_then(|typing| typing.refused.as_ref());
    let past = shared.document.states().take(shared.document.present() + 1);
    let steps = past.filter_map(|state| state.name.map(StepName::to_string));
    Some(match name {
        "text" => shared.document.text().to_owned(),
        "dirty" => shared.document.is_dirty().words(),
        "language" => shared.document.language().extension().to_owned(),
        "undoable" => shared.document.undoable().words(),
        "steps" => joined(steps, "; "),
        "step" => shared.document.present().to_string(),
        "errors" => count(shared.error_count()),
        "reported" => count(shared.reported.len()),
        "wrong" => findings(app),
        "at" => shared.cursor.selected().to_string(),
        "named" => shared.source().name(shared.cursor.selected()),
        "field" => shared.cursor.field.to_string(),
        "typed" => typing.map(|typing| typing.input.value()).words(),
        "refused" => refused.map(|refused| &refused.message).words(),
        "expected" => refused.map(|refused| &refused.expected).words(),
        "parts" => {
            let parts = shared.cursor.parts().iter();
            joined(parts.map(|(depth, node)| format!("{depth} {node}")), ", ")
        }
        "inputs" => shared.open_line().is_some().words(),
        "marks" => count(shared.cursor.marks.len()),
        "nodes" => count(shared.nodes().len()),
        "list" => list(app),
        "views" => {
            let views = shared.source().saved_views().into_iter();
            joined(views.map(|view| view.name), ", ")
        }
        "objects" => scene.map(|scene| scene.objects.len()).words(),
        _ => return None,
    })
}

/// Settings of pictures, and what is on screen.
fn settings(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let (output, window) = (shared.output(), display::frame_window(shared));
    Some(match name {
        "mode" => shared.mode.name().to_owned(),
        "context" => format!("{:?}", shared.context()),
        "size" => format!("{}x{}", output.width, output.height),
        "integrator" => shared.rendering().integrator().name().to_owned(),
        "overridden" => shared.is_integrator_changed().words(),
        "rendering" => format!("{:?}", shared.rendering()),
        "aov" => shared.pictures.aov.map(Aov::name).words(),
        "region" => shared.pictures.region.is_some().words(),
        "exposure" => display::display_name(shared).words(),
        "exposed" => window.map(|window| window.display.half_stops).words(),
        "transforms" => app.moving.is_some().words(),
        "denoised" => window.is_some_and(|window| window.display.denoised).words(),
        "view-name" => display::view_name(shared).words(),
        "legend" => display::legend(shared).words(),
        "raster" => shared
            .raster()
            .map(|(cells, _)| format!("{}x{}", cells.width, cells.height))
            .words(),
        "theme" => format!("{:?}", shared.theme),
        "panels" => {
            let areas = shared.areas();
            format!("{},{}", areas.border.x, areas.fields.y)
        }
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
    let shared = &app.shared;
    let overlays = &shared.overlays;
    let (menu, help) = (overlays.menu.as_ref(), overlays.page(Context::Help));
    let past = overlays.messages.past().map(|message| &message.text);
    let failed = overlays.message.as_ref().filter(|_| overlays.has_failed());
    let prompt = overlays.prompt.as_ref();
    let entries = menu.map(|menu| menu.shown()).unwrap_or_default();
    Some(match name {
        "says" => words(app).to_owned(),
        "shown" => shown(app).to_owned(),
        "buffer" => shared.buffer.as_ref().map_or_else(String::new, |buffer| {
            let mark = if buffer.is_changed { "*" } else { "" };
            format!("{}{mark}", buffer.editor)
        }),
        "past" => joined(past, "; "),
        "fault" => failed.map(|message| &message.text).words(),
        "asks" => question(app),
        "loses" => files::losses(shared).words(),
        "prompt" => prompt
            .map(|prompt| format!(":{}", prompt.input.value()))
            .words(),
        "completed" => {
            let found = command::completions(shared).into_iter();
            let found = found.map(|found| format!("{} [{}]", found.shown, found.keys));
            ended(found, "; ")
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
        "page-steps" => overlays
            .page(Context::History)
            .map(|page| page_steps(page, shared))
            .words(),
        "listed-error" => overlays.errors.words(),
        _ => return None,
    })
}

/// The working view: `camera` in full, `stands` and `target` exactly, and `view` rounded.
fn camera(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let camera = shared.camera();
    Some(match name {
        "camera" => format!("{camera:?}"),
        "stands" => camera
            .map(|camera| format!("{} {}", camera.eye, camera.up))
            .words(),
        "target" => camera.map(|camera| camera.target).words(),
        "view" => camera.map(|camera| rounded(&camera)).words(),
        "moved" => shared.pictures.view.is_some().words(),
        _ => return None,
    })
}

/// The pictures, and what is over them.
fn pictures(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let latest = shared.picture().latest.as_ref();
    let histogram = shared.pictures.histogram.as_ref();
    let counted = histogram.and_then(|shown| shown.histogram.as_ref());
    Some(match name {
        "picture" => latest.is_some().words(),
        "first" => latest.map(|frame| frame.pixels[0][0]).words(),
        "awaited" => shared.picture().wanted.is_some().words(),
        "paused" => shared.picture().paused.words(),
        "unfinished" => shared.pictures.are_awaited().words(),
        "traced" => shared.pictures.trace.is_some().words(),
        "corner" => shared.pictures.preview.shown.object_at(0, 0).words(),
        "under" => match inspect::node_at(shared, [0, 0]) {
            Ok(node) => node.words(),
            Err(_) => "unknown".to_owned(),
        },
        "compared-at" => app.compare.cross.map(place).words(),
        "outlined" => joined(display::outlined_objects(shared), " "),
        "symbols" => joined(
            display::symbols(shared).iter().map(|symbol| symbol.node),
            ", ",
        ),
        "symbol-cells" => {
            let symbols = display::symbols(shared);
            let symbols = symbols.iter();
            let cells = symbols.map(|symbol| format!("{} {}", symbol.node, place(symbol.cell)));
            joined(cells, ", ")
        }
        "wires" => wires(app),
        "solo" => shared.pictures.solo.is_some().words(),
        "histogram" => counted.map(counts).words(),
        "thumbnails" => app.thumbnails.are_awaited().words(),
        _ => return None,
    })
}

/// Which part of the picture is on screen, and the cross over it.
fn zoom(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let (corner, cross) = (display::pixel_in_corner(shared), inspect::cross(shared));
    Some(match name {
        "seen" => effects::name(shared.seen()).to_owned(),
        "zoomed" => (!display::viewport(shared).is_fit()).words(),
        "top-left" => corner.map(place).words(),
        "drawn" => shared.region_drawn().words(),
        "cross" => cross.map(|cross| place(cross.pixel)).words(),
        "cross-cell" => inspect::cross_cell(shared).map(place).words(),
        _ => return None,
    })
}

/// The explanation of a pixel: its lines, and the one under the cursor.
fn rays(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let explained = shared.inspection.explained.as_ref();
    let line = inspect::ray_line(shared);
    let node = line.and_then(|line| inspect::ray_node(shared, line));
    Some(match name {
        "explained" => inspect::explanation(shared)
            .map(|found| format!("{} sample {}", place(found.pixel), found.sample))
            .words(),
        "verdict" => explained.and_then(|found| found.verdict.as_ref()).words(),
        "rays" => count(inspect::ray_lines(shared).len()),
        "ray" => explained.map(|found| found.at).words(),
        "ray-of" => node.words(),
        _ => return None,
    })
}

/// The comparison with a reference.
fn comparison(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let compared = &app.compare;
    Some(match name {
        "contrast" => compared.view.name().into_owned(),
        "figures" => compared.are_figures_final().words(),
        "reference" => compared.reference.as_ref().map(|found| &found.name).words(),
        "comparing" => compared.is_awaited().words(),
        "unlike" => compare::unlike(&app.compare, shared).words(),
        _ => return None,
    })
}

/// Files, saves, exports and the track.
fn work(app: &App, name: &str) -> Option<String> {
    let shared = &app.shared;
    let export = shared.jobs.export();
    let track = app.sequence.open.as_ref();
    let writing = shared.jobs.still_writing();
    let taught = tutor::shown(&app.tutor, shared);
    Some(match name {
        "lesson" => taught.map(|taught| taught.title).words(),
        "task" => taught.map(|taught| taught.words).words(),
        "hint" => taught.and_then(|taught| taught.hint).words(),
        "disk" => {
            let state = format!("{:?}", shared.disk.state).to_lowercase();
            state.split('(').next().map(str::to_owned).words()
        }
        "path" => shared.disk.path.as_ref().map(|path| path.display()).words(),
        "polls" => files::polls(shared).words(),
        "unkept" => files::fails_to_keep(shared).words(),
        "awaits" => shared.assets.are_awaited().words(),
        "opening" => shared.disk.is_opening().words(),
        "leaving" => shared.jobs.next.is_some().words(),
        "writing" => writing
            .map(|(path, time)| format!("{} {time}", path.display()))
            .words(),
        "exporting" => export
            .map(|export| export.destination.path.display())
            .words(),
        "done" => export.map(Export::done).words(),
        "queued" => count(shared.jobs.queued()),
        "frame" => track.map(|open| open.frame).words(),
        "plays" => track.is_some_and(|open| open.is_playing).words(),
        "held" => track.and_then(|open| open.held.as_ref()).words(),
        _ => return None,
    })
}

/// What is found wrong, and where.
fn findings(app: &App) -> String {
    let shared = &app.shared;
    let wrong = shared.wrong();
    let found = wrong.findings.iter().map(|found| {
        let place = found.span.of(wrong.text);
        format!("{} at {place}", found.message_with_file())
    });
    joined(found, ", ")
}

/// The question that is open; of a conflict the base, mine and theirs of each place, and the
/// decision.
fn question(app: &App) -> String {
    let shared = &app.shared;
    match &shared.overlays.dialog {
        None => String::new(),
        Some(Dialog::Leave(AfterLeaving::Quit)) => "quit".to_owned(),
        Some(Dialog::Leave(AfterLeaving::Open(path))) => format!("open {}", path.display()),
        Some(Dialog::Leave(AfterLeaving::New(_))) => "new".to_owned(),
        Some(Dialog::Leave(AfterLeaving::Carried(carried))) => format!("open {}", carried.name),
        Some(Dialog::Leave(next @ AfterLeaving::Editor)) => {
            format!("editor: {}", files::question_before(shared, next).text)
        }
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
                select::question_before_deleting(shared, nodes).text
            )
        }
        Some(Dialog::Overwrite(_)) => "overwrite".to_owned(),
        Some(Dialog::Recover(offer)) => {
            format!("recover {} {}", offer.places, offer.conflicts())
        }
    }
}

/// The lines of the wireframe on screen.
fn wires(app: &App) -> String {
    let shared = &app.shared;
    let size = shared.raster().map(|(_, size)| size);
    let wireframe = shared.wireframe().zip(size);
    let lines = wireframe.and_then(|(wireframe, size)| wireframe.lines(size));
    let lines = lines.iter().flat_map(|wireframe| &wireframe.lines);
    joined(lines.map(|line| format!("{line:?}")), " ")
}

/// The bins of a histogram that are not empty, and how much is clipped.
fn counts(histogram: &Histogram) -> String {
    let bins = histogram.bins.iter().enumerate();
    let filled = bins.filter(|(_, count)| 0 < **count);
    let filled = joined(filled.map(|(at, count)| format!("{at}: {count}")), ", ");
    format!("{filled}; clipped {}", histogram.clipped)
}

/// The rows of the page of the history, with the cursor.
fn page_steps(page: &Page, shared: &Shared) -> String {
    let rows = page.shown().into_iter().map(|(_, name)| name).enumerate();
    let cursor = |at: usize| if at == page.filter.at { ">" } else { "" };
    let when = |at| history::when(&shared.document, at);
    joined(
        rows.map(|(at, name)| format!("{}{}: {name}", cursor(at), when(at))),
        "; ",
    )
}

/// A count, nothing for none.
fn count(count: usize) -> String {
    match count {
        0 => String::new(),
        count => count.to_string(),
    }
}

/// A column and a row.
fn place<T: ToString>(at: impl Into<[T; 2]>) -> String {
    joined(at.into(), ",")
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
    let shared = &app.shared;
    let lines = (0..shared.listing().len()).filter_map(|line| shared.listing().get(line));
    let nodes = lines.filter_map(|line| match line {
        ListLine::Heading(_) => None,
        ListLine::Node(_, node) => Some(node),
    });
    let marked = nodes.map(|node| {
        let is_folded = matches!(node, Node::Object(at) if shared.cursor.rows.is_folded(at));
        let fold = if is_folded { "+" } else { "" };
        let is_selected = node == shared.cursor.selected();
        let cursor = if is_selected { ">" } else { "" };
        format!("{cursor}{fold}{}", shared.source().name(node))
    });
    joined(marked, ", ")
}
