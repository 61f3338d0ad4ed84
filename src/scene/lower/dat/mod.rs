//! The grammar of `.dat`: records as the table of fields lists them, one a line. A record that
//! makes no sense costs itself only.

mod camera;
mod line;
mod objects;
mod shapes;
mod surfaces;

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::Lowered;
use super::report::{nearest_word, quoted};
use crate::format::dat::Tree;
use crate::geometry::{Operation, Shape};
use crate::scene::fields::Category;
use crate::scene::fields::dat::{Heads, RECORDS, RecordKind, TextureKind, UseKind};
use crate::scene::origins::dat::{Origins, VIEW};
use crate::scene::{self, Light, Material, Phong, Rgb, Scene, Setting, Source, Texture};
use crate::text::{Diagnostic, Findings, Position, Span};
use line::Line;

/// Reads a scene.
pub(super) fn lower(text: &str, tree: &Tree) -> Lowered {
    let mut reader = Reader {
        text,
        tree,
        report: Findings::default(),
        origins: Origins::default(),
        camera: camera::Said::default(),
        lights: Vec::new(),
        materials: Vec::new(),
        textures: Vec::new(),
        solids: Vec::new(),
        ids: HashMap::new(),
        used: HashMap::new(),
        drawn: Drawn::Results,
    };
    for record in 0..tree.records.len() {
        reader.record(record);
    }
    let objects = reader.drawn();
    let camera = reader.camera(&objects);
    let ambient = |light: &Light| match light.source {
        Source::Everywhere => light.colour,
        Source::Point { .. } | Source::Distant(_) => Rgb::ZERO,
    };
    let scene = (reader.report.errors() == 0).then(|| Scene {
        camera,
        ambient: reader.lights.iter().map(ambient).sum(),
        lights: reader.lights,
        materials: reader.materials.into_iter().map(Material::Phong).collect(),
        textures: reader.textures,
        objects: objects.into_iter().collect(),
        setting: Setting::default(),
    });
    Lowered {
        scene,
        origins: scene::Origins::Dat(reader.origins),
        diagnostics: reader.report.sorted(),
    }
}

/// An object of the text.
enum Solid {
    /// A shape of its own.
    Shape(Shape),
    /// Others combined; its operands are the origin's.
    Combined(Operation),
    /// An object with errors: something is known by its number all the same.
    Faulty,
}

/// What was read so far.
struct Reader<'a> {
    text: &'a str,
    tree: &'a Tree,
    report: Findings,
    origins: Origins,
    camera: camera::Said,
    /// Of all records, those with errors included: their indices are the origins'.
    lights: Vec<Light>,
    materials: Vec<Phong>,
    textures: Vec<Texture>,
    solids: Vec<Solid>,
    /// The index of each thing that is known by a number.
    ids: HashMap<(Category, i64), usize>,
    /// What was done to each material, by its index: the place in the origins.
    used: HashMap<(usize, UseKind), usize>,
    /// What the last `render` draws.
    drawn: Drawn,
}

/// Which objects are drawn.
enum Drawn {
    /// Those that are no operands, for want of a record.
    Results,
    /// All of them; where the text says so.
    All(Span),
    /// Those with these numbers.
    Listed(Vec<(i64, Span)>),
}

impl Reader<'_> {
    fn record(&mut self, record: usize) {
        let tokens = self.tree.tokens_of(record);
        let Some(kind) = self.kind(tokens) else {
            return;
        };
        if let Some(at) = VIEW.iter().position(|&view| view == kind) {
            let before = self.origins.view[at].replace(record);
            self.warn_of_repetition(before, tokens[0]);
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
                let before = self.origins.render.replace(record);
                self.warn_of_repetition(before, tokens[0]);
                self.render_list(tokens);
            }
        }
    }

    /// Which record the first words say; `None`, with a message, if none.
    fn kind(&mut self, tokens: &[Span]) -> Option<RecordKind> {
        let first = *tokens.first()?;
        let word = first.of(self.text);
        let Some((_, heads)) = RECORDS.iter().find(|(known, _)| *known == word) else {
            self.report.warning(|| unknown_record(first, word));
            return None;
        };
        let known = match heads {
            Heads::One(RecordKind::Texture(_)) => {
                // The pattern follows the number: texture ID n image.
                let is_image = tokens.get(3).is_some_and(|at| at.of(self.text) == "image");
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
        let second = tokens.get(1).copied();
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
                None => format!("{first}: the line ends where its kind is due"),
            };
            let diagnostic = Diagnostic::error(place, message, words.join(", "));
            let near = words.iter().find(|known| known.eq_ignore_ascii_case(word));
            match near
                .copied()
                .or_else(|| nearest_word(word, words.iter().copied()))
            {
                Some(near) => diagnostic.with_hint(format!("did you mean `{near}`?")),
                None => diagnostic,
            }
        });
        None
    }

    fn warn_of_repetition(&mut self, before: Option<usize>, word: Span) {
        let Some(before) = before else {
            return;
        };
        self.report.warning(|| {
            let line = Position::of(self.text, self.tree.span_of(before).start()).line;
            let message = format!("{}: said in line {line} already", word.of(self.text));
            Diagnostic::warning(word, message, "one record of this kind")
                .with_hint("the last one counts")
        });
    }

    /// The number by which a record is known, in `line`; warns of one that is taken, whose record
    /// is dropped then. `None` if it is, or is no number.
    fn know(&mut self, category: Category, line: &Line<'_>, index: usize) -> Option<i64> {
        let (id, span) = line.id?;
        match self.ids.entry((category, id)) {
            Entry::Vacant(entry) => {
                entry.insert(index);
                Some(id)
            }
            Entry::Occupied(_) => {
                self.report.warning(|| {
                    let word = category.word();
                    let message = format!("{word} {id}: defined above already");
                    Diagnostic::warning(span, message, "a number of its own")
                        .with_hint("this record is dropped")
                });
                None
            }
        }
    }

    /// The thing that a reference names; `None`, and an error, if there is none above.
    fn known(&mut self, category: Category, reference: Option<(i64, Span)>) -> Option<usize> {
        let (id, span) = reference?;
        let found = self.ids.get(&(category, id)).copied();
        if found.is_none() {
            self.report.error(|| {
                let word = category.word();
                let mut ids: Vec<_> = self.ids.keys().filter(|key| key.0 == category).collect();
                ids.sort_unstable_by_key(|key| key.1);
                let message = format!("there is no {word} {id} above");
                let expected = "the ID of one defined before";
                let shown: Vec<_> = ids.iter().take(8).map(|key| key.1.to_string()).collect();
                let hint = match shown.len() {
                    _ if is_defined_below(self.text, self.tree, span, category, id) => {
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

/// Whether a record below `span` begins as if it defined a thing with this number.
fn is_defined_below(text: &str, tree: &Tree, span: Span, category: Category, id: i64) -> bool {
    let (word, place) = match category {
        Category::Light => ("light", 2),
        Category::Material => ("mat", 2),
        Category::Texture => ("texture", 2),
        Category::Object => ("obj", 3),
    };
    let said = |tokens: &[Span], at: usize| tokens.get(at).map(|token| token.of(text));
    (tree.records_at(span).end..tree.records.len())
        .map(|record| tree.tokens_of(record))
        .any(|tokens| {
            let number = said(tokens, place).and_then(|number| number.parse().ok());
            said(tokens, 0) == Some(word) && number == Some(id)
        })
}

fn unknown_record(span: Span, word: &str) -> Diagnostic {
    let known = || RECORDS.iter().map(|(word, _)| *word);
    let expected = known().collect::<Vec<_>>().join(", ");
    let message = format!("unknown record {}: the line is skipped", quoted(word));
    let diagnostic = Diagnostic::warning(span, message, expected);
    let same = known().find(|known| known.eq_ignore_ascii_case(word));
    match same.or_else(|| nearest_word(word, known())) {
        Some(near) => diagnostic.with_hint(format!("did you mean `{near}`?")),
        None => diagnostic.with_hint("`//` or `#` begins a comment line"),
    }
}
