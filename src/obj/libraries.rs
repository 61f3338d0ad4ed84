//! The materials of a mesh and the libraries that define them.

use std::collections::HashMap;

use super::findings::{File, Findings};
use super::lines::{Fault, Spot, Statement, Word};
use super::mtl::{self, Material};
use super::{Finding, MAX_LIBRARIES};
use geometry::SlotRun;
use text::visible;

/// The libraries and the materials that a mesh names.
#[derive(Default)]
pub(super) struct Libraries {
    named: Vec<Named>,
    /// The slots of materials by name; slot 0 means no material.
    slots: HashMap<String, u32>,
    /// The names of slots from 1 on, where they are used first.
    used: Vec<Named>,
}

/// A name in a mesh.
struct Named {
    name: String,
    place: Spot,
    /// The length as written, in bytes.
    length: usize,
}

impl Named {
    fn new(word: Word<'_>) -> Self {
        Self {
            name: word.name(),
            place: word.place,
            length: word.text.len(),
        }
    }

    fn fault(&self, message: String, expected: &str) -> Fault {
        Fault {
            place: self.place,
            length: self.length,
            message,
            expected: expected.to_owned(),
            cost: "",
        }
    }
}

impl Libraries {
    /// Adds the libraries that a `mtllib` names.
    pub(super) fn add(&mut self, statement: &Statement<'_>) -> Result<(), Fault> {
        let names = statement.rest();
        if names.text.is_empty() {
            let message = "mtllib: the name is missing";
            return Err(Fault::new(
                statement.end(),
                message,
                "a material library (.mtl)",
            ));
        }
        if self.named.len() == MAX_LIBRARIES {
            let message = format!("more than {MAX_LIBRARIES} mtllib statements");
            let fault = Fault::new(
                statement.keyword(),
                message,
                format!("at most {MAX_LIBRARIES} libraries"),
            );
            return Err(fault.costing("the library is not read"));
        }
        self.named.push(Named::new(names));
        Ok(())
    }

    /// Begins a run of triangles with the material that a `usemtl` names. Without a name they have
    /// none, and it fails.
    pub(super) fn use_material(
        &mut self,
        statement: &Statement<'_>,
        first: u32,
        runs: &mut Vec<SlotRun>,
    ) -> Result<(), Fault> {
        let name = statement.rest();
        let slot = if name.text.is_empty() {
            0
        } else {
            let next = self.slots.len() as u32 + 1;
            let slot = *self.slots.entry(name.name()).or_insert(next);
            if slot == next {
                self.used.push(Named::new(name));
            }
            slot
        };
        match runs.last_mut() {
            Some(last) if last.first == first => last.slot = slot,
            Some(last) if last.slot == slot => {}
            _ => runs.push(SlotRun { first, slot }),
        }
        if slot == 0 {
            let message = "usemtl: the name is missing";
            let fault = Fault::new(statement.end(), message, "the name of a material");
            return Err(fault.costing("the faces that follow have none of its materials"));
        }
        Ok(())
    }

    /// Reads the libraries of a mesh. Returns the material of each slot and the warnings.
    pub(super) fn read<B: AsRef<[u8]>>(
        self,
        mesh: File<'_>,
        mut library: impl FnMut(&str) -> Result<B, String>,
    ) -> (Vec<Option<Material>>, Vec<Finding>) {
        let mut materials = HashMap::new();
        let mut findings = Findings::default();
        let mut seen: Vec<&str> = Vec::new();
        let mut is_complete = true;
        for named in &self.named {
            let names = named.name.as_str();
            if seen.contains(&names) {
                continue;
            }
            seen.push(names);
            // A line may name one library whose name contains blanks, or several.
            let several = names.contains(|c: char| c.is_ascii_whitespace());
            let read: Vec<_> = match library(names) {
                Err(_) if several => names
                    .split_ascii_whitespace()
                    .take(MAX_LIBRARIES)
                    .map(|name| (name, library(name)))
                    .collect(),
                bytes => vec![(names, bytes)],
            };
            for (name, bytes) in read {
                match bytes {
                    Ok(bytes) => {
                        let bytes = bytes.as_ref();
                        let is_used = |name: &str| self.slots.contains_key(name);
                        materials.extend(mtl::read(bytes, name, is_used, &mut findings));
                    }
                    Err(reason) => {
                        let message = format!("cannot read `{}`: {reason}", visible(name));
                        findings
                            .warn_first(mesh, named.fault(message, "a material library (.mtl)"));
                        is_complete = false;
                    }
                }
            }
        }
        let mut by_slot = vec![None];
        for used in &self.used {
            let material = materials.remove(&used.name);
            // The definitions in an unreadable library are not known.
            if material.is_none() && is_complete {
                let message = format!("no library defines `{}`", visible(&used.name));
                let fault = used.fault(message, "a material that a library defines");
                findings.warn(mesh, fault.costing("its faces are white"));
            }
            by_slot.push(material);
        }
        (by_slot, findings.finish())
    }
}
