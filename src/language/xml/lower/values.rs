//! Attributes as numbers, vectors, colours and words.

use glam::DVec3;

use super::Lowering;
use crate::report::{number_of, out_of_range};
use crate::schema::{Field, Kind};
use crate::xml::parameter::{Attributes, Parameter, Single};
use crate::xml::tree::Attribute;
use scene::Transfer;
use text::{Diagnostic, Findings, Span, is_integer};

impl<'a> Lowering<'a> {
    /// The name of an element in messages: its node's, and its own if it differs.
    pub(super) fn display_name(&self, element: usize) -> String {
        let name = self.name(element);
        let node = self.origins.node_of(element);
        match node {
            None => name.to_owned(),
            Some(node) if self.origins.owners[element] as usize == element => {
                self.origins.name(node)
            }
            Some(node) => format!("{} {name}", self.origins.name(node)),
        }
    }

    /// A word stated by an element; `None` if missing.
    pub(super) fn word(&self, element: usize, word: &str) -> Option<&'a str> {
        let word = self.value(element, word)?.unescaped(self.text);
        (!word.is_empty()).then_some(word)
    }

    /// The attribute of an element with this name.
    pub(super) fn value(&self, element: usize, word: &str) -> Option<&'a Attribute> {
        self.tree.attribute(self.text, element, word)
    }

    /// The name of an attribute's number in messages.
    fn what(&self, element: usize, attribute: &Attribute) -> String {
        let owner = self.display_name(element);
        match attribute.name.of(self.text) {
            "value" => owner,
            name => format!("{owner} {name}"),
        }
    }

    /// The checked number of an attribute; NaN, with an error, if malformed.
    fn number_at(&mut self, element: usize, attribute: &Attribute, field: &Field) -> f64 {
        let span = attribute.value;
        let word = attribute.unescaped(self.text).trim();
        let what = || self.what(element, attribute);
        let mut findings = Findings::default();
        let value = number_of(field, span, word, &mut findings, what);
        let is_too_large = field.kind == Kind::Side && f64::from(u32::MAX) < value;
        let is_fraction = field.kind == Kind::Side && !is_integer(word);
        if value.is_nan() {
            // Already reported.
        } else if is_too_large || is_fraction {
            let limits = if is_too_large {
                format!("{} at most", u32::MAX)
            } else {
                field.allowed.limits()
            };
            let message = format!("{}: must be {limits}", what());
            findings.error(|| Diagnostic::error(span, message, field.allowed.words()));
        } else if !field.allowed.contains(value) {
            findings.error(|| out_of_range(field, span, value, &what()));
        } else if !field.usual.contains(value) {
            findings.warning(|| out_of_range(field, span, value, &what()));
        }
        let is_valid = findings.errors() == 0;
        self.report.append(findings);
        if is_valid { value } else { f64::NAN }
    }

    /// A number of an element, or its default.
    fn number_or(
        &mut self,
        element: usize,
        attribute: &str,
        field: &Field,
        otherwise: &str,
    ) -> f64 {
        match self.value(element, attribute) {
            Some(at) => self.number_at(element, at, field),
            None => plain(otherwise),
        }
    }

    /// The number of a parameter, or its default.
    pub(super) fn number(&mut self, holder: Option<usize>, parameter: &'static Parameter) -> f64 {
        match self.element_of(holder, parameter) {
            Some(element) => self.number_or(element, "value", &parameter.field, parameter.inside),
            None => plain(parameter.missing[0]),
        }
    }

    /// The vector or colour of a parameter, or its default.
    pub(super) fn vector(&mut self, holder: Option<usize>, parameter: &'static Parameter) -> DVec3 {
        let element = self.element_of(holder, parameter);
        self.vector_in(element, parameter)
    }

    /// The vector or colour stated by an element, or its default if there is none.
    pub(super) fn vector_in(
        &mut self,
        element: Option<usize>,
        parameter: &'static Parameter,
    ) -> DVec3 {
        let Some(element) = element else {
            return DVec3::from_array([0, 1, 2].map(|at| plain(parameter.missing[at])));
        };
        let names = parameter.reading.attributes();
        let field = &parameter.field;
        let [x, y, z] =
            [0, 1, 2].map(|at| self.number_or(element, names[at], field, parameter.inside));
        let vector = DVec3::new(x, y, z);
        if parameter.reading == Attributes::Rotation {
            return vector;
        }
        let product = self.number_or(element, "value", field, "1") * vector;
        if !product.is_nan() && !product.is_finite() {
            let name = self.display_name(element);
            let message = || format!("{name}: too large for any number");
            self.error(self.place(element), message, "numbers up to about 1.8e308");
        }
        product
    }

    /// The angle of a rotation, in degrees; 0 for another transform.
    pub(super) fn angle_in(&mut self, element: usize, parameter: &'static Parameter) -> f64 {
        if parameter.reading != Attributes::Rotation {
            return 0.0;
        }
        let angle = match self.value(element, "angle") {
            Some(_) => "angle",
            None => "value",
        };
        self.number_or(element, angle, &parameter.field, "0")
    }

    /// A further number of a parameter, or its default.
    pub(super) fn extra(
        &mut self,
        holder: usize,
        parameter: &'static Parameter,
        extra: &Single,
    ) -> f64 {
        match self.element_of(Some(holder), parameter) {
            Some(element) => {
                let missing = extra.missing(self.origins.transfer);
                self.number_or(element, extra.attribute, &extra.field, missing)
            }
            None => plain(extra.missing(Transfer::Linear)),
        }
    }

    /// The child that sets a parameter.
    pub(super) fn element_of(
        &self,
        holder: Option<usize>,
        parameter: &'static Parameter,
    ) -> Option<usize> {
        self.origins.parameter(self.tree, holder?, parameter)
    }

    /// All attributes of an element, or its name if it has none.
    pub(super) fn attributes_span(&self, element: usize) -> Span {
        match &self.tree.attributes[self.tree.elements[element].attributes()] {
            [] => self.place(element),
            own @ [first, ..] => first.name.to(own[own.len() - 1].value),
        }
    }
}

/// Parses a number of the table of fields.
fn plain(literal: &str) -> f64 {
    literal.parse().unwrap_or(f64::NAN)
}
