//! What scripts can check: `says` and `shown` are messages, the newest and the one in the status
//! line; `does` names effects of the last step, `does only` all of them in order, `does first` the
//! first of them, and `does once` one of which there is no other; `lists` are folders whose names it
//! asks for; `job` gives settings of the only picture that it traces, in pairs; `text` and `saved`
//! are texts, `writes` is that of the file that is written, and `over` what it may replace; `news`
//! is how the file that was read last differs.

use super::values::{self, Words as _};
use super::*;
use crate::msg::Guard;
use scene::Size;

impl Session {
    /// Whether a check holds, and what there is in its place.
    pub(super) fn holds(&self, check: &str) -> Result<(bool, String), String> {
        let (name, pattern) = check.split_once(' ').unwrap_or((check, ""));
        let pattern = &self.named(pattern);
        Ok(match name {
            "text" => return self.is_text(self.app.shared.document.text(), pattern),
            "saved" => return self.is_text(self.app.shared.document.saved(), pattern),
            "writes" => return self.is_text(self.written()?, pattern),
            "over" => match self.guard()? {
                Guard::Holding(text) => return self.is_text(&text, pattern),
                Guard::Absent => (pattern == "nothing", "nothing".to_owned()),
                Guard::Anything => (pattern == "anything", "anything".to_owned()),
            },
            "does" => self.does(pattern),
            "job" => self.is_job(pattern)?,
            _ => {
                let found = self.seen(name, pattern)?;
                let holds = match pattern.as_str() {
                    "" => !found.is_empty(),
                    pattern => is_like(&found, &unescaped(pattern)),
                };
                (holds, found)
            }
        })
    }

    fn is_text(&self, found: &str, words: &str) -> Result<(bool, String), String> {
        let is_it = if words.contains('…') {
            is_like(found, &unescaped(words))
        } else {
            self.text_of(words)? == found
        };
        Ok((
            is_it,
            format!("{:?} in\n{found}", self.app.shared.overlays.message),
        ))
    }

    /// The first text that is written.
    fn written(&self) -> Result<&str, String> {
        let mut written = self.effects.iter().filter_map(|effect| match effect {
            Effect::Save { text, .. } | Effect::WriteTrack { text, .. } => Some(text.as_str()),
            Effect::Film(_, reel, _) => Some(reel.text.as_str()),
            Effect::Recall(_, origin, _) => Some(origin.text.as_str()),
            Effect::LookForKept(sought) => Some(sought.text.as_str()),
            Effect::CopyText(text) => Some(text.as_str()),
            Effect::WriteRecovery { known, .. } => Some(known.text().as_str()),
            _ => None,
        });
        Ok(written.next().ok_or("nothing is written")?)
    }

    /// What the first file that is written may replace, or what edits that are kept derive from.
    fn guard(&self) -> Result<Guard, String> {
        let mut guards = self.effects.iter().filter_map(|effect| match effect {
            Effect::Save { guard, .. } | Effect::WriteTrack { guard, .. } => Some(guard.clone()),
            Effect::WriteRecovery { known, .. } => Some(Guard::Holding(Arc::clone(&known.saved))),
            _ => None,
        });
        Ok(guards.next().ok_or("nothing is written")?)
    }

    pub(super) fn does(&self, pattern: &str) -> (bool, String) {
        let done: Vec<_> = self.effects.iter().map(effects::called).collect();
        let is = |done: &String, pattern: &str| {
            let rest = done.strip_prefix(pattern);
            is_like(done, pattern) || rest.is_some_and(|rest| rest.starts_with(' '))
        };
        let holds = if let Some(pattern) = pattern.strip_prefix("only ") {
            let patterns: Vec<_> = pattern.split(", ").collect();
            let mut pairs = done.iter().zip(&patterns);
            done.len() == patterns.len() && pairs.all(|(done, pattern)| is(done, pattern))
        } else if let Some(pattern) = pattern.strip_prefix("first ") {
            let mut pairs = pattern.split(", ").enumerate();
            pairs.all(|(at, pattern)| done.get(at).is_some_and(|done| is(done, pattern)))
        } else if let Some(pattern) = pattern.strip_prefix("once ") {
            done.iter().filter(|done| is(done, pattern)).count() == 1
        } else if pattern.is_empty() {
            !done.is_empty()
        } else {
            let mut patterns = pattern.split(", ");
            patterns.all(|pattern| done.iter().any(|done| is(done, pattern)))
        };
        (holds, done.join(", "))
    }

    fn last_job(&self) -> Result<&Job, String> {
        let last = self.effects.iter().rev().find_map(traced_by);
        Ok(last.ok_or("nothing is traced")?.1)
    }

    /// Whether the only picture that is traced has these settings.
    fn is_job(&self, pairs: &str) -> Result<(bool, String), String> {
        let mut jobs = self.effects.iter().filter_map(traced_by);
        let (Some((_, job)), None) = (jobs.next(), jobs.next()) else {
            return Err(format!("not one picture: {}", self.does("").1));
        };
        let Size { width, height } = job.camera.size;
        let settings = job.settings.written().into_iter().chain([
            (
                "limit",
                job.limit
                    .map_or_else(|| "none".to_owned(), |limit| format!("{limit:?}")),
            ),
            ("spp", job.settings.spp.to_string()),
            ("denoise", job.denoise.to_string()),
            ("frames", format!("{:?}", job.frames)),
            ("camera", format!("{width}x{height}")),
            ("objects", job.scene.objects.len().to_string()),
        ]);
        let settings: Vec<_> = settings.collect();
        let words: Vec<_> = pairs.split(' ').collect();
        let has = |pair: &[&str]| match pair {
            ["image", name] => job.images.get(name).is_some(),
            [name, wanted] => {
                let mut known = settings.iter();
                known.any(|(known, value)| known == name && is_like(value, wanted))
            }
            _ => false,
        };
        Ok((words.chunks(2).all(has), format!("{settings:?}")))
    }

    /// What is seen under a name; nothing is an empty text.
    pub(super) fn seen(&self, name: &str, pattern: &str) -> Result<String, String> {
        let text = self.app.shared.document.text();
        Ok(match name {
            "line" => {
                let (line, _) = pattern.split_once(' ').ok_or("which line?")?;
                let at: usize = line.parse().map_err(|_| "which line?")?;
                format!("{at} {}", text.lines().nth(at - 1).unwrap_or(""))
            }
            "lines" => {
                let old: Vec<_> = self.texts["opened"].lines().collect();
                let new = text.lines().filter(|line| !old.contains(line));
                new.map(str::trim).collect::<Vec<_>>().join(", ")
            }
            // The numbers of the objects that the last picture shows alone, and the red of its
            // ambient light and of its lights.
            "alone" => {
                let numbers = self.last_job()?.numbers.as_deref();
                values::joined(numbers.unwrap_or_default(), " ")
            }
            "reds" => {
                let scene = &self.last_job()?.scene;
                let lights = scene.lights.iter().map(|light| light.colour.x);
                values::joined([scene.ambient.x].into_iter().chain(lights), " ")
            }
            "derived" | "news" => self.texts.get(name).cloned().unwrap_or_default(),
            "lists" => values::joined(self.under_way.listings.iter().map(effects::called), ", "),
            "fresh" => self.is_fresh().words(),
            _ => {
                let seen = values::seen(&self.app, name);
                seen.ok_or_else(|| format!("nothing is called {name}"))?
            }
        })
    }

    /// Whether the scene, the findings and the last thing are those of the text as if it were just
    /// opened.
    fn is_fresh(&self) -> bool {
        let name = format!("scene.{}", self.app.shared.document.language().extension());
        let fresh = opened_as(&name, self.app.shared.document.text()).0;
        let (shared, fresh) = (&self.app.shared, &fresh.shared);
        let last = shared.nodes().iter().last();
        shared.scene == fresh.scene
            && shared.diagnostics == fresh.diagnostics
            && last.is_none_or(|node| shared.source().fields(node) == fresh.source().fields(node))
    }
}
