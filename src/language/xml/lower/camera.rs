//! The camera, background and environment.

use super::Lowering;
use crate::camera::{CameraSpans, check};
use crate::rendering::{Part, RenderPlace};
use crate::report::quoted;
use crate::xml::origins::fields::of_gamma;
use crate::xml::parameter::Parameter;
use crate::xml::schema::{BACKGROUND, CAMERA, ENVIRONMENT};
use crate::xml::view;
use scene::{Camera, Transfer};
use text::{Diagnostic, Span, parse_number, without_suffix};

impl Lowering<'_> {
    /// The camera of its element, with defaults for missing parts; `root` is the place of messages
    /// about a missing one.
    pub(super) fn camera(&mut self, root: Span) -> Camera {
        let camera = self.origins.camera;
        let whole = camera.map_or(root, |camera| self.place(camera));
        if let Some(camera) = camera {
            self.gamma(camera);
        } else {
            let message = || "no `camera` element".to_owned();
            let hint = "the default is at the origin and looks along −z";
            self.warn(root, message, "`<camera>` in `<xml>`", hint);
        }
        let [vectors @ .., _, _, _, _, _] = *CAMERA;
        let [_, _, _, numbers @ ..] = *CAMERA;
        self.origins.factors = vectors.map(|parameter| {
            let attribute = self.value(self.element_of(camera, parameter)?, "value")?;
            // Reports of malformed numbers are made where they are read.
            let word = attribute.unescaped(self.text).trim();
            Some(parse_number(without_suffix(word).unwrap_or(word)).unwrap_or(1.0))
        });
        let place = |parameter: &'static Parameter| {
            let element = self.element_of(camera, parameter);
            element.map_or(whole, |element| self.attributes_span(element))
        };
        let [eye, target, up] = vectors.map(place);
        let places = CameraSpans {
            eye,
            target,
            up,
            whole,
            remedy: "give its position and target: <position/>, <target/>",
        };
        let vectors = vectors.map(|parameter| self.vector(camera, parameter));
        let numbers = numbers.map(|parameter| self.number(camera, parameter));
        let seen = view::camera_of(vectors, numbers);
        // Malformed numbers were already reported.
        if !vectors.iter().any(|vector| vector.is_nan()) {
            check(&seen, &places, &mut self.report);
        }
        seen
    }

    fn gamma(&mut self, camera: usize) {
        let Some(attribute) = self.value(camera, "gamma") else {
            return;
        };
        let word = attribute.unescaped(self.text);
        if word.eq_ignore_ascii_case("sRGB") {
            self.origins.transfer = Transfer::Srgb;
        } else if !word.eq_ignore_ascii_case("linear") {
            let message = || format!("camera gamma: unknown value {}", quoted(word));
            let hint = "it is treated as linear";
            self.warn(attribute.value, message, "sRGB or linear", hint);
        }
    }

    /// Reads the render settings: those of their element, completed by what `gamma` asks for.
    pub(super) fn rendering(&mut self) {
        let Some(render) = self.origins.render else {
            self.setting.rendering = of_gamma(self.origins.transfer);
            return;
        };
        let (text, tree) = (self.text, self.tree);
        let mut settings = RenderPlace::new(tree.elements[render].whole);
        settings.holds_more = !tree.elements[render].is_empty_tag();
        for attribute in &tree.attributes[tree.elements[render].attributes()] {
            let value = attribute.value;
            let part = Part {
                // With the quote.
                whole: Span::new(attribute.name.start(), value.end() + 1),
                value,
            };
            let word = attribute.unescaped(text).trim();
            settings.read(attribute.name.of(text), word, part, &mut self.report);
        }
        self.setting.rendering = settings.rendering.or(of_gamma(self.origins.transfer));
        self.origins.settings = settings;
    }

    /// Reads background and environment; `root` is the place of messages about a missing scene.
    pub(super) fn surroundings(&mut self, root: Span) {
        let Some(scene) = self.origins.scene else {
            let warning = Diagnostic::warning(root, "no `scene` element", "`<scene>` in `<xml>`");
            self.report.warning(|| warning);
            return;
        };
        self.setting.background = self.tinted(scene, &BACKGROUND);
        self.setting.environment = self.tinted(scene, &ENVIRONMENT);
    }
}
