//! Many pictures against one, or against those of a folder: a row for each, whatever it is. Of all that is
//! read and traced, a reference and one submission are in memory at a time.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use super::compared::Class;
use super::matching::{Matching, Pair};
use super::row::{Counts, Found, Row};
use super::side::{Model, Traced, Untraced, is_picture, read, trace};
use super::thumbnail::{Thumbnail, Thumbnails};
use super::{Compare, Report, ReportFormat, Verdict, matching, report, table};
use crate::output::Output;
use crate::{Error, Messages, stdout};
use ::compare::{Comparison, Reference};
use ::explain::{Subject, parting, verdicts};
use ::render::{Explanation, Job, PictureMetadata, PreparedScene, Provenance};
use file::ReadError;
use language::Source;
use text::{Diagnostic, Findings, counted};

/// Compares all and reports them.
pub(super) fn compare(work: &Compare) -> Result<Verdict, Error> {
    let found = prepare(work).and_then(|matching| {
        let (class, first_failure) = compare_all(work, matching)?;
        tell(&class)?;
        let all_alike = class
            .rows
            .iter()
            .all(|row| row.verdict() == Some(Verdict::Alike));
        let verdict = if all_alike {
            Verdict::Alike
        } else {
            Verdict::Different
        };
        Ok((verdict, first_failure))
    });
    let (verdict, first_failure) = found.inspect_err(|error| Messages::Text.error(error))?;
    // It has been told in its row.
    first_failure.map_or(Ok(verdict), Err)
}

/// Finds what is to be compared, and checks before any work that all that is to be written can be.
fn prepare(work: &Compare) -> Result<Matching, Error> {
    work.reading.begin()?;
    if let Some((path, _)) = &work.output {
        return Err(Error::Refused(format!(
            "{} would show the differences of two files; of more, --report draws them in an .html",
            path.display()
        )));
    }
    let matching = matching::of(work)?;
    for path in work.outputs() {
        let output = Output::File(path.to_owned());
        let submissions: Vec<_> = matching.pairs.iter().map(|pair| &pair.submission).collect();
        output.check_is_not(&submissions, "it is one of those compared")?;
        output.check_is_not(&matching.references, "it is one of those compared")?;
        output.check()?;
    }
    Ok(matching)
}

/// Compares the pairs of each reference in turn, so that each reference is read and prepared once.
fn compare_all(work: &Compare, matching: Matching) -> Result<(Class<'_>, Option<Error>), Error> {
    let Matching {
        references,
        pairs,
        listing,
    } = matching;
    let shows = work
        .reports
        .iter()
        .any(|(_, format)| *format == ReportFormat::Html);
    let mut rows: Vec<(usize, Row)> = Vec::with_capacity(pairs.len());
    let mut failures: Vec<(usize, Error)> = Vec::new();
    let mut used = Vec::new();
    let mut pairs: Vec<_> = pairs.into_iter().enumerate().collect();
    pairs.sort_by_key(|(at, pair)| (pair.reference, *at));
    let mut standard: Option<(usize, Standard)> = None;
    for (
        at,
        Pair {
            submission,
            reference,
        },
    ) in pairs
    {
        let Some(index) = reference else {
            let reason = "has no reference of its name".to_owned();
            let error = Error::Refused(format!("{} {reason}", submission.display()));
            rows.push((at, Row::failed(submission, None, reason)));
            failures.push((at, error));
            continue;
        };
        if standard.as_ref().is_none_or(|(of, _)| *of != index) {
            // Two are never in memory.
            drop(standard.take());
            let read = Standard::new(work, references[index].clone(), shows)?;
            used.push((read.path.clone(), read.thumbnail.clone()));
            standard = Some((index, read));
        }
        let Some((_, standard)) = &standard else {
            continue;
        };
        let row = standard.row(work, &submission, shows);
        match row {
            Ok(row) => rows.push((at, row)),
            Err(Failed::Row(row, error)) => {
                rows.push((at, *row));
                failures.push((at, error));
            }
            Err(Failed::All(error)) => return Err(error),
        }
    }
    rows.sort_by_key(|(at, _)| *at);
    let mut rows: Vec<_> = rows.into_iter().map(|(_, row)| row).collect();
    failures.sort_by_key(|(at, _)| *at);
    let mut first_failure = failures.into_iter().next().map(|(_, error)| error);
    listing.tell_links();
    for (path, source) in listing.unreadable {
        rows.push(Row::failed(path.clone(), None, source.to_string()));
        first_failure.get_or_insert_with(|| ReadError::Io { path, source }.into());
    }
    let class = Class {
        work,
        references: used,
        rows,
    };
    Ok((class, first_failure))
}

/// Prints the figures and writes the documents.
fn tell(class: &Class<'_>) -> Result<(), Error> {
    let printed = match class.work.report {
        Report::Text => table::table(class),
        Report::Json => report::json(class),
    };
    stdout::print(&printed).map_err(stdout::error)?;
    for (path, format) in &class.work.reports {
        let text = format.text(class);
        Output::File(path.clone()).write(&mut |out| out.write_all(text.as_bytes()))?;
        Messages::Text.note(&format!("wrote {}", path.display()));
    }
    Ok(())
}

/// Why there are no figures.
enum Failed {
    /// The submission cannot be compared, which is a row.
    Row(Box<Row>, Error),
    /// Nothing can be.
    All(Error),
}

/// A reference that was read or traced.
struct Standard {
    path: PathBuf,
    prepared: Reference,
    record: Option<PictureMetadata>,
    holds_light: bool,
    scene: Option<Explained>,
    thumbnail: Option<Thumbnail>,
}

impl Standard {
    /// Reads a picture, or traces a scene.
    fn new(work: &Compare, path: PathBuf, shows: bool) -> Result<Self, Error> {
        let (image, record, holds_light, scene) = if is_picture(&path) {
            let read = read(&path)?;
            (read.image, read.record, read.holds_light, None)
        } else {
            let traced = trace(work, &path, None)?;
            let errors = traced.loaded.findings.errors();
            let (image, job) = traced.picture.ok_or(Error::Invalid { errors })?;
            let record = record_of(&job);
            let scene = Explained::new(traced.loaded.source, job);
            (image, Some(record), false, scene)
        };
        Ok(Self {
            thumbnail: shows.then(|| Thumbnail::mean_of(&image)).flatten(),
            prepared: Reference::new(image),
            path,
            record,
            holds_light,
            scene,
        })
    }

    /// Compares a submission with it.
    fn row(&self, work: &Compare, submission: &Path, shows: bool) -> Result<Row, Failed> {
        let failed = |reason: String, findings: Option<Counts>, error: Error| {
            let row = Row {
                findings,
                ..Row::failed(submission.to_owned(), Some(self.path.clone()), reason)
            };
            Failed::Row(Box::new(row), error)
        };
        let mut scene = None;
        let mut findings = None;
        let image = if is_picture(submission) {
            let read = read(submission);
            read.map_err(|error| failed(reason(submission, &error), None, error))?
                .image
        } else {
            let model = Model {
                path: &self.path,
                size: self.prepared.image().size(),
                record: self.record.as_ref(),
                holds_light: self.holds_light,
            };
            let not_traced = |error| failed(reason(submission, &error), None, error);
            let untraced = Untraced::read(work, submission, Some(model), Messages::Off);
            let untraced = untraced.map_err(not_traced)?;
            untraced.check_spared().map_err(Failed::All)?;
            let Traced { loaded, picture } = untraced.trace().map_err(not_traced)?;
            let counts = Counts::of(&loaded.findings);
            let Some((image, job)) = picture else {
                let errors = counts.errors;
                let reason = first_error(&loaded.findings, loaded.source.text());
                return Err(failed(reason, Some(counts), Error::Invalid { errors }));
            };
            findings = Some(counts);
            scene = Explained::new(loaded.source, job);
            image
        };
        let figures = self.prepared.compared(&image, work.tolerance);
        let verdict = Verdict::of(&figures, work.max_differing);
        let explained = match (&figures, verdict) {
            (Ok(figures), Verdict::Different) => self.explain(figures, scene.as_ref()),
            _ => None,
        };
        Ok(Row {
            submission: submission.to_owned(),
            reference: Some(self.path.clone()),
            thumbnails: shows.then(|| Thumbnails::of(&image, self.prepared.image())),
            found: Found::Compared { figures, verdict },
            findings,
            explained,
        })
    }

    /// Says why the worst pixel differs, as far as there are scenes that can be asked.
    fn explain(&self, figures: &Comparison, scene: Option<&Explained>) -> Option<String> {
        let worst = figures.worst.first()?;
        let at =
            |scene: Option<&Explained>| scene.and_then(|scene| scene.explain([worst.x, worst.y]));
        let verdict = |scene: &Explained, explanation: &Explanation| {
            let verdicts = verdicts(explanation, &scene.subject());
            verdicts.into_iter().next().map(|verdict| verdict.text)
        };
        match (
            (scene, at(scene)),
            (self.scene.as_ref(), at(self.scene.as_ref())),
        ) {
            ((Some(own), Some(a)), (Some(reference), Some(b))) => {
                let subjects = [&own.subject(), &reference.subject()];
                let said = parting([&a, &b], subjects);
                Some(said.unwrap_or_else(|| {
                    "the same rays at the centre of the pixel: edges or settings differ".to_owned()
                }))
            }
            ((Some(own), Some(a)), _) => Some(format!("here: {}", verdict(own, &a)?)),
            (_, (Some(reference), Some(b))) => {
                Some(format!("in the reference: {}", verdict(reference, &b)?))
            }
            _ => None,
        }
    }
}

impl Row {
    fn failed(submission: PathBuf, reference: Option<PathBuf>, reason: String) -> Self {
        Self {
            submission,
            reference,
            found: Found::Failed(reason),
            findings: None,
            explained: None,
            thumbnails: None,
        }
    }
}

/// A scene that can be asked about its pixels.
struct Explained {
    source: Source,
    job: Job,
    /// Prepared at the first question.
    prepared: OnceCell<Option<PreparedScene>>,
}

impl Explained {
    /// `None` if the picture shows something else than light.
    fn new(source: Source, job: Job) -> Option<Self> {
        job.settings.aov.is_none().then(|| Self {
            source,
            job,
            prepared: OnceCell::new(),
        })
    }

    fn subject(&self) -> Subject<'_> {
        Subject {
            source: &self.source,
            scene: &self.job.scene,
            camera: &self.job.camera,
            size: self.job.settings.size,
        }
    }

    /// Explains the centre of a pixel, which is counted in what was traced of the picture.
    fn explain(&self, [x, y]: [u32; 2]) -> Option<Explanation> {
        let traced = self.job.settings.traced();
        let prepare = || PreparedScene::new(&self.job, &|| false);
        let prepared = self.prepared.get_or_init(prepare).as_ref()?;
        let pixel = [x + traced.x, y + traced.y];
        prepared.query().explain(pixel, 0, &|| false)
    }
}

/// What the file of a traced picture would say of how it was made, so that other scenes are traced alike.
fn record_of(job: &Job) -> PictureMetadata {
    let spp = job.settings.spp;
    let lines = Provenance::of(job, "-".to_owned()).lines();
    PictureMetadata::read(&format!("{lines}spp {spp}\n"))
}

/// What is wrong with a submission, without its name.
fn reason(submission: &Path, error: &Error) -> String {
    let said = error.to_string();
    let name = submission.display().to_string();
    let rest = said.strip_prefix(&name).unwrap_or(&said);
    rest.trim_start_matches([':', ' ']).to_owned()
}

/// The first error of a text with its place, and how many more there are.
fn first_error(findings: &Findings, text: &str) -> String {
    let Some(first) = findings.iter().find(|finding| finding.is_error()) else {
        return counted(findings.errors(), "error");
    };
    let more = match findings.errors() - 1 {
        0 => String::new(),
        more => format!(" (and {})", counted(more, "more error")),
    };
    format!("{}{more}", placed(first, text))
}

/// A finding with its line and column.
fn placed(finding: &Diagnostic, text: &str) -> String {
    let position = finding.shown(text).position;
    let message = finding.message_with_file();
    format!("line {}:{}: {message}", position.line, position.column)
}
