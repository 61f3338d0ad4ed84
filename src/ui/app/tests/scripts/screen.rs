//! Frames, references and the mouse in scripts.

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::steps::number;
use super::*;
use crate::reference::{Made, ReferenceRead};
use render::{Frame, Job, NO_OBJECT, PictureMetadata};
use scene::{Images, Size};

impl Session {
    /// A complete frame of what is traced, of this generation or the first; and one of 16 samples
    /// with another grey in its first pixel, and in others by their numbers.
    pub(super) fn frame(&self, target: Target, rest: &str) -> Result<Msg, String> {
        let size = self.job(target)?.settings.size;
        let mut frame = frame_of(size, vec![0; size.pixels()]);
        let (generation, grey) = rest.split_once(" first ").unwrap_or((rest, ""));
        if !generation.is_empty() {
            frame.generation = number(generation)?;
        }
        if !grey.is_empty() {
            let words: Vec<_> = grey.split(' ').collect();
            frame.progress.spp = 16;
            frame.pixels[0] = [number(words[0])?; 3];
            for pixel in words[1..].chunks_exact(2) {
                frame.pixels[number::<usize>(pixel[0])?] = [number(pixel[1])?; 3];
            }
        }
        Ok(Msg::Frame(target, Arc::new(frame)))
    }

    /// What was traced last for a picture.
    pub(super) fn job(&self, target: Target) -> Result<&Job, String> {
        let mut jobs = self.under_way.jobs.iter().rev();
        Ok(&jobs.find(|(of, _)| *of == target).ok_or("not traced")?.1)
    }

    /// The figures of the pictures that are compared.
    pub(super) fn measured(&self) -> Result<Msg, String> {
        let pairs = self.effects.iter().find_map(|effect| match effect {
            Effect::Compare(pair) => Some(pair.clone()),
            _ => None,
        });
        let pair = pairs.ok_or("nothing is compared")?;
        let found = pair.compare().ok().map(Arc::new);
        Ok(Msg::Compared(pair, found))
    }

    /// What is compared with: `picture WxH`, after which its file says how it was made, a `scene`,
    /// or why there is none.
    pub(super) fn reference(&self, rest: &str) -> Result<Msg, String> {
        let id = self.app.compare.requested();
        let (kind, rest) = rest.split_once(' ').unwrap_or((rest, ""));
        let read = match kind {
            "picture" => {
                let (size, record) = rest.split_once(' ').unwrap_or((rest, ""));
                let (width, height) = size.split_once('x').ok_or("no size")?;
                let size = Size {
                    width: number(width)?,
                    height: number(height)?,
                };
                let frame = Frame::drawn(size, vec![[0; 3]; size.pixels()]);
                let record = (!record.is_empty()).then(|| unescaped(&self.named(record)));
                let made = Made {
                    record: record.map(|text| Box::new(PictureMetadata::read(&text))),
                    holds_light: false,
                };
                Ok(ReferenceRead::Picture(Arc::new(frame), made))
            }
            "scene" => {
                let scene = opened_as("scene.ray", &self.text_of(rest)?).0.shared.scene;
                let scene = scene.ok_or("it has errors")?;
                Ok(ReferenceRead::Scene(scene, Images::default()))
            }
            _ => Err(rest.to_owned()),
        };
        Ok(Msg::ReferenceRead(id, read))
    }

    /// Shows a complete preview of an object everywhere, of `none`, or of object 1 in its left
    /// `half`.
    pub(super) fn shows(&mut self, what: &str) -> Result<(), String> {
        let (_, size) = self.app.shared.raster().ok_or("there is no room")?;
        let object = |at: u32| match what {
            "half" if at % size.width < size.width / 2 => Ok(1),
            "half" | "none" => Ok(NO_OBJECT),
            number_of => number(number_of),
        };
        let objects = (0..size.pixels() as u32).map(object);
        let frame = frame_of(size, objects.collect::<Result<_, _>>()?);
        self.update(Msg::Frame(Target::Preview, Arc::new(frame)));
        let picture = self.app.shared.picture_mut();
        picture.advance(&FrameWindow::whole(size), &[], usize::MAX);
        Ok(())
    }

    /// A mouse event over a cell of an area, by button or key.
    pub(super) fn mouse(&self, name: &str, area: &str, rest: &str) -> Result<Msg, String> {
        let areas = self.app.shared.areas();
        let area = match area {
            "errors" => areas.errors,
            "list" => areas.list,
            "fields" => areas.fields,
            "picture" => self.app.shared.raster().ok_or("there is no room")?.0,
            "screen" => ratatui::layout::Rect::default(),
            _ => return Err(format!("no area is called {area}")),
        };
        let (cell, held) = rest.split_once(' ').unwrap_or((rest, ""));
        let (column, row) = cell.split_once(',').ok_or("no cell")?;
        let button = match held {
            "right" => MouseButton::Right,
            "middle" => MouseButton::Middle,
            _ => MouseButton::Left,
        };
        let kind = match name {
            "down" => MouseEventKind::Down(button),
            "drag" => MouseEventKind::Drag(button),
            "up" => MouseEventKind::Up(button),
            _ => MouseEventKind::ScrollUp,
        };
        let modifiers = match held {
            "ctrl" => KeyModifiers::CONTROL,
            _ => KeyModifiers::NONE,
        };
        Ok(Msg::Mouse(MouseEvent {
            kind,
            column: area.x + number::<u16>(column)?,
            row: area.y + number::<u16>(row)?,
            modifiers,
        }))
    }
}
