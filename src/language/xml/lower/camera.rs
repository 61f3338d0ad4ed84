//! The camera, background and environment.

use super::Lowering;
use crate::camera::{CameraSpans, check};
use crate::rendering::{Part, RenderPlace};
use crate::report::quoted;
use crate::xml::origins::fields::of_gamma;
use crate::xml::table::{
    BACKGROUND, ENVIRONMENT, Parameter,
    camera::{FOCAL_DISTANCE, FOV, HEIGHT, LENS_RADIUS, POSITION, TARGET, UP, WIDTH},
};
use crate::xml::view::View;
use scene::{Camera, Focus, Size, Transfer};
use text::{Diagnostic, Span, parse_number, without_suffix};

impl Lowering<'_> {
    /// The camera of its element, with defaults for missing parts.
    pub(super) fn camera(&mut self) -> Camera {
        let camera = self.origins.camera;
        let root = self
            .origins
            .root
            .map_or_else(Span::default, |root| self.place(root));
        let whole = camera.map_or(root, |camera| self.place(camera));
        if camera.is_none() {
            let hint = "the default is at the origin and looks along −z";
            self.warn(
                root,
                || "no `camera` element".to_owned(),
                "`<camera>` in `<xml>`",
                hint,
            );
        }
        if let Some(camera) = camera {
            self.gamma(camera);
        }
        let vectors = [&POSITION, &TARGET, &UP];
        self.origins.factors = vectors.map(|parameter| {
            let element = self.element_of(camera, parameter)?;
            let attribute = self.origins.value(self.tree, element, "value")?;
            // Reports of malformed numbers are made where they are read.
            let word = attribute.unescaped(self.text).trim();
            Some(parse_number(without_suffix(word).unwrap_or(word)).unwrap_or(1.0))
        });
        let [position, target, up] = vectors.map(|parameter| self.vector(camera, parameter));
        let numbers = [&FOV, &FOCAL_DISTANCE, &LENS_RADIUS, &WIDTH, &HEIGHT];
        let [fov, distance, lens_radius, width, height] =
            numbers.map(|parameter| self.number(camera, parameter));
        let view = View {
            position,
            target,
            up,
            fov,
            focus: Focus {
                distance,
                lens_radius,
            },
            size: Size {
                width: width as u32,
                height: height as u32,
            },
        };
        let place = |parameter: &'static Parameter| {
            let element = self.element_of(camera, parameter);
            element.map_or(whole, |element| self.attributes_span(element))
        };
        let places = CameraSpans {
            eye: place(&POSITION),
            target: place(&TARGET),
            up: place(&UP),
            whole,
            remedy: "give its position and target: <position/>, <target/>",
        };
        // Malformed numbers were already reported.
        let seen = view.camera();
        if !(position.is_nan() || target.is_nan() || up.is_nan()) {
            check(&seen, &places, &mut self.report);
        }
        seen
    }

    fn gamma(&mut self, camera: usize) {
        let Some(attribute) = self.origins.value(self.tree, camera, "gamma") else {
            return;
        };
        let word = attribute.unescaped(self.text);
        if word.eq_ignore_ascii_case("sRGB") {
            self.origins.transfer = Transfer::Srgb;
        } else if !word.eq_ignore_ascii_case("linear") {
            let message = || format!("camera gamma: unknown value {}", quoted(word));
            self.warn(
                attribute.value,
                message,
                "sRGB or linear",
                "it is treated as linear",
            );
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

    /// Reads background and environment.
    pub(super) fn surroundings(&mut self) {
        let scene = self.origins.scene;
        let Some(scene) = scene else {
            let root = self
                .origins
                .root
                .map_or_else(Span::default, |root| self.place(root));
            self.report.warning(|| {
                let message = "no `scene` element";
                Diagnostic::warning(root, message, "`<scene>` in `<xml>`")
            });
            return;
        };
        if let Some(element) = self.element_of(Some(scene), &BACKGROUND) {
            self.setting.background = self.tinted_in(element, &BACKGROUND);
        }
        if let Some(element) = self.element_of(Some(scene), &ENVIRONMENT) {
            self.setting.environment = self.tinted_in(element, &ENVIRONMENT);
        }
    }
}
