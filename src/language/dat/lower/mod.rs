//! The grammar of `.dat`: one record per line, according to the table of fields. Invalid records do
//! not affect others.

mod camera;
mod objects;
mod record;
mod shapes;
mod surfaces;

use std::cell::OnceCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::origins::{Origins, VIEW};
use super::table::{Heads, RECORDS, RecordKind, TextureKind, UseKind};
use super::tree::{Tree, render_comment};
use crate::Lowered;
use crate::rendering::{given_again, read_comment};
use crate::report::{did_you_mean, quoted};
use crate::table::Category;
use crate::words::Words;
use geometry::{Operation, Solid};
use record::RecordContent;
use scene::{Light, Material, Rgb, Scene, Setting, Texture};
use text::{Diagnostic, Findings, Position, Span, nearest_word};

/// Maximum number of IDs listed in a message.
const NAMED: usize = 8;

/// Returns the errors of every text that begins with these records.
pub(super) fn errors_of_beginning(text: &str, tree: &Tree) -> Findings {
    let mut lowering = Lowering::new(text, tree);
    // The last record may be incomplete.
    for record in 0..tree.records.len().saturating_sub(1) {
        lowering.record(record);
    }
    lowering.report
}

/// Lowers a text.
pub(super) fn lower(text: &str, tree: &Tree) -> (Origins, Lowered) {
    let mut lowering = Lowering::new(text, tree);
    for record in 0..tree.records.len() {
        lowering.record(record);
    }
    lowering.settings();
    let objects = lowering.drawn();
    let camera = lowering.camera(&objects);
    let rendering = lowering.origins.settings.map(|place| place.rendering);
    let scene = (lowering.report.errors() == 0).then(|| Scene {
        camera,
        ambient: Rgb::ZERO,
        lights: lowering.lights,
        materials: lowering.materials.into(),
        textures: lowering.textures,
        objects: objects.into_iter().collect(),
        setting: Setting {
            rendering: rendering.unwrap_or_default(),
            ..Setting::default()
        },
    });
    let lowered = Lowered {
        scene,
        diagnostics: lowering.report.sorted(),
    };
    (lowering.origins, lowered)
}

/// An object of the text.
enum Definition {
    /// A single solid, and the index of its material.
    Solid(Solid, u32),
    /// A combination; its operands are in the origins.
    Combined(Operation),
    /// An object with errors; it still has an ID.
    Faulty,
}

/// A lowering in progress.
struct Lowering<'a> {
    text: &'a str,
    tree: &'a Tree,
    report: Findings,
    origins: Origins,
    camera: camera::Records,
    /// From all records, including those with errors: indices are those of the origins.
    lights: Vec<Light>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    parts: Vec<Definition>,
    /// The index of each node with an ID.
    ids: HashMap<(Category, i64), usize>,
    /// The smallest IDs of each category, ascending, at most [`NAMED`].
    smallest: [Vec<i64>; 4],
    /// The last record that defines each ID; computed when a message first needs it.
    definitions: OnceCell<HashMap<(Category, i64), usize>>,
    /// The uses of textures by each material, by its index: indices in the origins.
    used: HashMap<(usize, UseKind), usize>,
    /// The objects drawn according to the last `render`.
    drawn: Drawn,
}

/// The objects to draw.
enum Drawn {
    /// All except operands, by default.
    Results,
    /// All, as requested at this place.
    All(Span),
    /// The objects with these IDs.
    Listed(Vec<(i64, Span)>),
}

impl<'a> Lowering<'a> {
    fn new(text: &'a str, tree: &'a Tree) -> Self {
        Self {
            text,
            tree,
            report: Findings::default(),
            origins: Origins::default(),
            camera: camera::Records::default(),
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            parts: Vec::new(),
            ids: HashMap::new(),
            smallest: Default::default(),
            definitions: OnceCell::new(),
            used: HashMap::new(),
            drawn: Drawn::Results,
        }
    }
}

impl Lowering<'_> {
    /// Reads the first comment with render settings; warns of those after it.
    fn settings(&mut self) {
        for &line in &self.tree.renders {
            let Some(body) = render_comment(self.text, line) else {
                continue;
            };
            let mut findings = Findings::default();
            let Some(place) = read_comment(self.text, line, body, &mut findings) else {
                self.report.append(findings);
                continue;
            };
            if self.origins.settings.is_some() {
                self.report.warning(|| given_again(line));
            } else {
                self.report.append(findings);
                self.origins.settings = Some(place);
            }
        }
    }

    fn record(&mut self, record: usize) {
        let tokens = &self.tree.tokens_of(self.text, record);
        let Some(kind) = self.kind(tokens) else {
            return;
        };
        if let Some(at) = VIEW.iter().position(|&view| view == kind)
            && let Some(before) = self.origins.view[at].replace(record)
        {
            self.warn_of_repetition(before, tokens.clone().next());
        }
        match kind {
            RecordKind::Camera | RecordKind::Resolution | RecordKind::Viewport => {
                self.view_record(kind, tokens);
            }
            RecordKind::Light => self.light(record, tokens),
            RecordKind::Material => self.material(record, tokens),
            RecordKind::Object(kind) => self.object(record, kind, tokens),
            RecordKind::Texture(kind) => self.texture(record, kind, tokens),
            RecordKind::Use(kind) => self.texture_use(record, kind, tokens),
            RecordKind::Render => {
                if let Some(before) = self.origins.render.replace(record) {
                    self.warn_of_repetition(before, tokens.clone().next());
                }
                self.render_list(tokens);
            }
        }
    }

    /// The kind of record identified by the first words; `None`, with a message, if unknown.
    fn kind(&mut self, tokens: &Words<'_>) -> Option<RecordKind> {
        let mut rest = tokens.clone();
        let first = rest.next()?;
        let word = first.of(self.text);
        let Some((_, heads)) = RECORDS.iter().find(|(known, _)| *known == word) else {
            self.report.warning(|| unknown_record(first, word));
            return None;
        };
        let known = match heads {
            Heads::One(RecordKind::Texture(_)) => {
                // The pattern follows the ID: texture ID n image.
                let is_image = rest.nth(2).is_some_and(|at| at.of(self.text) == "image");
                let kind = if is_image {
                    TextureKind::Image
                } else {
                    TextureKind::Checker
                };
                return Some(RecordKind::Texture(kind));
            }
            Heads::One(kind) => return Some(*kind),
            Heads::Two(known) => *known,
        };
        let second = rest.next();
        let word = second.map_or("", |at| at.of(self.text));
        if let Some((_, kind)) = known.iter().find(|(known, _)| *known == word) {
            return Some(*kind);
        }
        let words: Vec<_> = known.iter().map(|(word, _)| *word).collect();
        let place = second.unwrap_or_else(|| Span::at(first.end()));
        self.report.error(|| {
            let first = first.of(self.text);
            let message = match second {
                Some(_) => format!("{first}: unknown kind {}", quoted(word)),
                None => format!("{first}: the line ends before its kind"),
            };
            let diagnostic = Diagnostic::error(place, message, words.join(", "));
            did_you_mean(diagnostic, nearest_word(word, words.iter().copied()), None)
        });
        None
    }

    /// Warns of a record that replaces the one at index `before`.
    fn warn_of_repetition(&mut self, before: usize, word: Option<Span>) {
        let word = word.unwrap_or_default();
        self.report.warning(|| {
            let line = Position::of(self.text, self.tree.span_of(before).start()).line;
            let message = format!("{}: already given in line {line}", word.of(self.text));
            Diagnostic::warning(word, message, "one record of this kind")
                .with_hint("the last one counts")
        });
    }

    /// Registers the ID of a record, read in `line`. `None` if it is malformed, or, with a warning,
    /// if it is taken; then the record is dropped.
    fn define(
        &mut self,
        category: Category,
        line: &RecordContent<'_>,
        index: usize,
    ) -> Option<i64> {
        let (id, span) = line.id?;
        match self.ids.entry((category, id)) {
            Entry::Vacant(entry) => {
                entry.insert(index);
                let smallest = &mut self.smallest[category as usize];
                let at = smallest.partition_point(|&known| known < id);
                if at < NAMED {
                    smallest.truncate(NAMED - 1);
                    smallest.insert(at, id);
                }
                Some(id)
            }
            Entry::Occupied(_) => {
                self.report.warning(|| {
                    let word = category.word();
                    let message = format!("{word} {id}: already defined above");
                    Diagnostic::warning(span, message, "a unique ID")
                        .with_hint("this record is ignored")
                });
                None
            }
        }
    }

    /// The node that a reference names; `None`, with an error, if it is not defined above.
    fn resolve(&mut self, category: Category, reference: Option<(i64, Span)>) -> Option<usize> {
        let (id, span) = reference?;
        let found = self.ids.get(&(category, id)).copied();
        if found.is_none() {
            let (text, tree) = (self.text, self.tree);
            let definitions = &self.definitions;
            self.report.error(|| {
                let all = definitions.get_or_init(|| definitions_of(text, tree));
                let below = all.get(&(category, id));
                let below = below.filter(|&&record| tree.records_at(span).end <= record);
                let word = category.word();
                let message = format!("there is no {word} {id} above");
                let expected = "the ID of one defined above";
                let shown = self.smallest[category as usize].iter();
                let shown: Vec<_> = shown.map(ToString::to_string).collect();
                let hint = match shown.len() {
                    _ if below.is_some() => {
                        format!("{word} {id} is defined below: it must come first")
                    }
                    0 => format!("no {word} is defined yet: it must come first"),
                    _ => format!("defined so far: {}", shown.join(", ")),
                };
                Diagnostic::error(span, message, expected).with_hint(hint)
            });
        }
        found
    }
}

/// The last record that appears to define each ID.
fn definitions_of(text: &str, tree: &Tree) -> HashMap<(Category, i64), usize> {
    let definition = |record: usize| {
        let tokens = tree.tokens_of(text, record);
        let word = |at: usize| Some(tokens.clone().nth(at)?.of(text));
        let (category, place) = match word(0)? {
            "light" => (Category::Light, 2),
            "mat" => (Category::Material, 2),
            "texture" => (Category::Texture, 2),
            "obj" => (Category::Object, 3),
            _ => return None,
        };
        Some(((category, word(place)?.parse().ok()?), record))
    };
    (0..tree.records.len()).filter_map(definition).collect()
}

fn unknown_record(span: Span, word: &str) -> Diagnostic {
    let words = RECORDS.iter().map(|(word, _)| *word);
    let expected = words.clone().collect::<Vec<_>>().join(", ");
    let message = format!("unknown record {}: the line is skipped", quoted(word));
    let diagnostic = Diagnostic::warning(span, message, expected);
    let otherwise = "`//` or `#` begins a comment line";
    did_you_mean(diagnostic, nearest_word(word, words), Some(otherwise))
}
