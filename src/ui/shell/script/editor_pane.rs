//! An editor's pane beside the screen of a recording: it shows a file, types into it and saves it.

use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

/// The columns of the pane, with those of its line numbers and of the border.
const WIDTH: u16 = 38;

/// The largest file that it opens.
const MOST_BYTES: u64 = 1 << 20;

/// The pane.
#[derive(Debug)]
pub(crate) struct EditorPane {
    path: PathBuf,
    text: String,
    /// What typing replaces; where it is empty, the cursor is.
    selected: Range<usize>,
    is_saved: bool,
    /// The first line shown.
    top: usize,
}

impl EditorPane {
    /// Opens a file of UTF-8, at most a megabyte of it.
    pub(crate) fn open(path: &Path) -> io::Result<Self> {
        let about = fs::metadata(path)?;
        if !about.is_file() || MOST_BYTES < about.len() {
            return Err(io::Error::other(
                "the pane opens files of at most a megabyte",
            ));
        }
        Ok(Self {
            path: path.to_owned(),
            text: fs::read_to_string(path)?,
            selected: 0..0,
            is_saved: true,
            top: 0,
        })
    }

    /// Selects the first place of a text after the cursor.
    pub(crate) fn find(&mut self, text: &str) -> io::Result<()> {
        let from = self.selected.end;
        let found = self.text[from..].find(text);
        let at = from + found.ok_or_else(|| io::Error::other(format!("{text}: not found")))?;
        self.selected = at..at + text.len();
        Ok(())
    }

    /// Replaces what is selected.
    pub(crate) fn type_text(&mut self, text: &str) {
        self.text.replace_range(self.selected.clone(), text);
        let end = self.selected.start + text.len();
        self.selected = end..end;
        self.is_saved = false;
    }

    /// Saves the file.
    pub(crate) fn save(&mut self) -> io::Result<()> {
        fs::write(&self.path, &self.text)?;
        self.is_saved = true;
        Ok(())
    }

    /// Draws the pane to the left of a screen.
    pub(crate) fn beside(&mut self, screen: &Buffer) -> Buffer {
        let height = screen.area.height;
        let mut cells = Buffer::empty(Rect::new(0, 0, WIDTH + screen.area.width, height));
        self.draw(&mut cells);
        for y in 0..height {
            cells.set_string(WIDTH - 1, y, "│", Style::new().fg(Color::DarkGray));
            for x in 0..screen.area.width {
                cells[(WIDTH + x, y)] = screen[(screen.area.x + x, screen.area.y + y)].clone();
            }
        }
        cells
    }

    /// Lines with their numbers, what is selected in reverse video, and the name of the file.
    fn draw(&mut self, cells: &mut Buffer) {
        let height = cells.area.height;
        let rows = usize::from(height.saturating_sub(1));
        let at = self.text[..self.selected.start].matches('\n').count();
        if at < self.top || self.top + rows <= at {
            self.top = at.saturating_sub(rows / 2);
        }
        let dimmed = Style::new().fg(Color::DarkGray);
        let width = usize::from(WIDTH - 7);
        let mut start: usize = self
            .text
            .split_inclusive('\n')
            .take(self.top)
            .map(str::len)
            .sum();
        for (row, line) in self.text[start..]
            .split_inclusive('\n')
            .take(rows)
            .enumerate()
        {
            let y = row as u16;
            cells.set_string(0, y, format!("{:>4} ", self.top + row + 1), dimmed);
            cells.set_stringn(5, y, line.trim_end(), width, Style::new());
            let is_comment = line.find("//");
            if let Some(at) = is_comment.filter(|at| *at < width) {
                let comment = line[at..].trim_end();
                cells.set_stringn(5 + at as u16, y, comment, width - at, dimmed);
            }
            if self.top + row == at {
                let column = self.text[start..self.selected.start].chars().count() as u16;
                let marked = self.text[self.selected.clone()].chars().count().max(1) as u16;
                let area = Rect::new(5 + column, y, marked, 1).intersection(cells.area);
                cells.set_style(area, Style::new().add_modifier(Modifier::REVERSED));
            }
            start += line.len();
        }
        let name = self.path.file_name().unwrap_or_default().display();
        let sign = if self.is_saved { "" } else { " [+]" };
        let bar = Style::new().add_modifier(Modifier::REVERSED);
        cells.set_style(Rect::new(0, height.saturating_sub(1), WIDTH - 1, 1), bar);
        cells.set_stringn(
            1,
            height.saturating_sub(1),
            format!("{name}{sign}"),
            width,
            bar,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of the pane beside an empty screen.
    fn rows(pane: &mut EditorPane) -> Vec<String> {
        let cells = pane.beside(&Buffer::empty(Rect::new(0, 0, 2, 4)));
        let row = |y| {
            (0..WIDTH)
                .map(|x| cells[(x, y)].symbol())
                .collect::<String>()
        };
        (0..4)
            .map(|y| row(y).trim_end_matches([' ', '│']).to_owned())
            .collect()
    }

    #[test]
    fn what_is_typed_is_shown_and_then_saved() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ray");
        fs::write(&path, "1 // one\n2 // two\n").expect("writable");
        let mut pane = EditorPane::open(&path).expect("a file");
        pane.find("2").expect("it is there");
        pane.type_text("3");
        pane.type_text(".5");
        let saved = || fs::read_to_string(&path).expect("text");
        assert_eq!(saved(), "1 // one\n2 // two\n");
        let expected = ["   1 1 // one", "   2 3.5 // two", "", " a.ray [+]"];
        assert_eq!(rows(&mut pane), expected);
        pane.save().expect("writable");
        assert_eq!(saved(), "1 // one\n3.5 // two\n");
        assert_eq!(rows(&mut pane)[3], " a.ray");
        assert!(pane.find("one").is_err(), "it is above the cursor");
        assert!(EditorPane::open(folder.path()).is_err());
    }
}
