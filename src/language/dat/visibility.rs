//! Edits that show or hide objects, in the `render` record of `.dat`.

use std::collections::HashSet;

use super::origins::Origins;
use super::tree::Tree;
use crate::Visibility;
use crate::view::line_ending;
use text::{Edit, Span};

const LAST: &str = "the last visible object cannot be hidden";

/// Returns the edits that show or hide objects, by index, and leave all others as they are.
///
/// # Errors
///
/// Fails with the reason if no text can express that.
pub(super) fn edits(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    objects: &[usize],
    wanted: Visibility,
) -> Result<Vec<Edit>, &'static str> {
    let is_drawn = |object: &usize| origins.drawn.binary_search(object).is_ok();
    let objects: HashSet<_> = objects.iter().copied().collect();
    let drawn: Vec<_> = (0..origins.objects.len())
        .filter(|object| match (objects.contains(object), wanted) {
            (true, Visibility::Shown) => true,
            (true, Visibility::Hidden) => false,
            (false, _) => is_drawn(object),
        })
        .collect();
    if drawn == origins.drawn {
        return Ok(Vec::new());
    }
    if drawn.is_empty() {
        return Err(LAST);
    }
    let edit = |span, text| Edit { span, text };
    let id = |object: usize| origins.objects.get(object).map(|at| at.id);
    let listed = || {
        let entries = drawn
            .iter()
            .filter_map(|&object| Some(format!("ID {}", id(object)?)));
        let words: Vec<_> = std::iter::once(drawn.len().to_string())
            .chain(entries)
            .collect();
        words.join(" ")
    };
    let Some(listing) = Listing::of(text, tree, origins) else {
        if let Some(count) = origins
            .render
            .and_then(|at| tree.tokens_of(text, at).nth(1))
        {
            return Ok(vec![edit(count, listed())]);
        }
        let ending = line_ending(text);
        let record = format!("render {}", listed());
        let line = if text.is_empty() || text.ends_with(['\n', '\r']) {
            format!("{record}{ending}")
        } else {
            format!("{ending}{record}")
        };
        return Ok(vec![edit(Span::at(text.len()), line)]);
    };
    match wanted {
        Visibility::Shown => {
            let new = drawn.iter().filter(|object| !is_drawn(object));
            let ids: Vec<_> = new
                .filter_map(|&object| Some(id(object)?.to_string()))
                .collect();
            Ok(listing.with(text, &ids))
        }
        Visibility::Hidden => {
            let gone = objects.iter().filter_map(|&object| id(object));
            let gone: HashSet<_> = gone.collect();
            listing
                .without(text, |listed| gone.contains(&listed))
                .ok_or(LAST)
        }
    }
}

/// A `render` record that lists objects.
pub(super) struct Listing {
    count: Span,
    /// The words `ID` and the IDs, as many as `render` states.
    entries: Vec<[Span; 2]>,
}

impl Listing {
    /// The `render` record of a text; `None` if it lists no objects.
    pub(super) fn of(text: &str, tree: &Tree, origins: &Origins) -> Option<Self> {
        let tokens: Vec<_> = tree.tokens_of(text, origins.render?).collect();
        let [_, count, entries @ ..] = tokens.as_slice() else {
            return None;
        };
        let stated = count.of(text).parse().unwrap_or(0);
        let entries = entries.chunks_exact(2).take(stated);
        let entries: Vec<_> = entries.map(|entry| [entry[0], entry[1]]).collect();
        (!entries.is_empty()).then_some(Self {
            count: *count,
            entries,
        })
    }

    /// The edits that add objects.
    pub(super) fn with(&self, text: &str, ids: &[String]) -> Vec<Edit> {
        self.exchanged(text, |_| false, ids).unwrap_or_default()
    }

    /// The edits that remove objects; `None` if no other is listed.
    pub(super) fn without(&self, text: &str, goes: impl Fn(i64) -> bool) -> Option<Vec<Edit>> {
        self.exchanged(text, goes, &[])
    }

    /// The edits that remove objects, each with the white space before it, and add others; `None`
    /// if none would be listed.
    pub(super) fn exchanged(
        &self,
        text: &str,
        goes: impl Fn(i64) -> bool,
        ids: &[String],
    ) -> Option<Vec<Edit>> {
        let edit = |span, text| Edit { span, text };
        let before = std::iter::once(self.count).chain(self.entries.iter().map(|entry| entry[1]));
        let mut edits: Vec<_> = before
            .zip(&self.entries)
            .filter(|(_, entry)| entry[1].of(text).parse().is_ok_and(&goes))
            .map(|(before, entry)| edit(Span::new(before.end(), entry[1].end()), String::new()))
            .collect();
        let left = self.entries.len() - edits.len() + ids.len();
        if !ids.is_empty() {
            let end = self.entries.last().map_or(self.count, |entry| entry[1]);
            let listed: Vec<_> = ids.iter().map(|id| format!(" ID {id}")).collect();
            edits.push(edit(Span::at(end.end()), listed.concat()));
        }
        if !edits.is_empty() {
            edits.insert(0, edit(self.count, left.to_string()));
        }
        (0 < left).then_some(edits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Language;
    use crate::tests::read_as;
    use scene::Meshes;
    use text::apply;

    /// Three spheres and the intersection of the first two, followed by `render`.
    fn scene(render: &str) -> String {
        format!(
            "mat ID 1 1 1 1 .1 .5 .4 9 0 0 1\n\
             obj sphere ID 4 mat ID 1 0 0 0 1\n\
             obj sphere ID 5 mat ID 1 1 0 0 1\n\
             obj sphere ID 6 mat ID 1 5 0 0 1\n\
             obj CSG ID 9 intersection ID 4 ID 5\n{render}"
        )
    }

    fn changed(text: &str, id: i64, wanted: Visibility) -> Result<String, &'static str> {
        let (source, _) = read_as(Language::Dat, text, &Meshes::default());
        let object = [4, 5, 6, 9].iter().position(|&known| known == id);
        let object = object.expect("one of the objects");
        let edits = source.visibility_edits(&[object], wanted)?;
        let mut changed = text.to_owned();
        apply(&mut changed, &edits);
        Ok(changed)
    }

    #[test]
    fn the_render_record_lists_what_is_drawn() {
        use Visibility::{Hidden, Shown};
        for (before, id, wanted, after) in [
            ("", 6, Hidden, "render 1 ID 9\n"),
            ("", 4, Shown, "render 3 ID 4 ID 6 ID 9\n"),
            ("", 6, Shown, ""),
            ("# end", 6, Hidden, "# end\nrender 1 ID 9"),
            ("# end\r", 6, Hidden, "# end\rrender 1 ID 9\n"),
            ("render 0 \t\n", 6, Hidden, "render 3 ID 4 ID 5 ID 9 \t\n"),
            ("render 0\n", 4, Shown, "render 0\n"),
            ("render 2  ID 9\tID 6\r\n", 9, Hidden, "render 1\tID 6\r\n"),
            ("render 2  ID 9\tID 6\n", 6, Hidden, "render 1  ID 9\n"),
            (
                "render 2  ID 9\tID 6\n",
                5,
                Shown,
                "render 3  ID 9\tID 6 ID 5\n",
            ),
            ("render 3 ID 6 ID 9 ID 6\n", 6, Hidden, "render 1 ID 9\n"),
        ] {
            let changed = changed(&scene(before), id, wanted);
            assert_eq!(changed, Ok(scene(after)), "{before:?} {id} {wanted:?}");
        }
    }

    #[test]
    fn the_last_object_cannot_be_hidden() {
        let one = scene("render 1 ID 6\n");
        assert!(changed(&one, 6, Visibility::Hidden).is_err());
    }
}
