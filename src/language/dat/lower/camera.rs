//! The camera, which three records say, and what stands in for those that are missing.

use glam::DVec3;

use super::Reader;
use crate::geometry::Aabb;
use crate::language::camera::{Places, check, default_eye_and_target};
use crate::language::dat::table::RecordKind;
use crate::language::record::Gathered;
use crate::language::report::Name;
use crate::scene::{Camera, Focus, Lens, Object, Size, bounds};
use crate::text::{Diagnostic, Span};

/// From where the default view looks, seen from the centre of the scene.
const DEFAULT_SIDE: DVec3 = DVec3::new(0.4, -1.0, 0.3);

/// The vertical angle of view where the text says none, in degrees.
const DEFAULT_ANGLE: f64 = 45.0;

const DEFAULT_SIZE: Size = Size {
    width: 800,
    height: 600,
};

/// How to say a camera.
const REMEDY: &str = "say a camera: camera perspective eye look up focal near far";

/// What the records say, as far as they are there and right.
#[derive(Default)]
pub(super) struct Said {
    camera: Option<(Gathered, Places)>,
    resolution: Option<[f64; 2]>,
    viewport: Option<Size>,
}

impl<'a> Reader<'a> {
    pub(super) fn view_record(&mut self, kind: RecordKind, tokens: &'a [Span]) {
        let name = Name::Record(match kind {
            RecordKind::Resolution => "resolution",
            RecordKind::Viewport => "viewport",
            _ => "camera",
        });
        let line = self.line(kind, tokens, |_| name);
        self.surplus(&line);
        let Some(said) = line.gather() else {
            return;
        };
        match kind {
            RecordKind::Resolution => self.camera.resolution = Some(said.pair),
            RecordKind::Viewport => self.viewport(said.pair, &line.spans),
            _ => {
                let [_, near, far, ..] = said.numbers;
                let near = near.max(0.0);
                if far <= near {
                    let far = line.spans[line.spans.len() - 1];
                    self.report.error(|| {
                        let message = "camera far: must be greater than near";
                        Diagnostic::error(far, message, format!("a number greater than {near}"))
                    });
                }
                let vector = |first: usize| line.spans[first].to(line.spans[first + 2]);
                let places = Places {
                    eye: vector(1),
                    target: vector(4),
                    up: vector(7),
                    whole: line.spans[0].to(line.spans[line.spans.len() - 1]),
                    remedy: REMEDY,
                };
                self.camera.camera = Some((said, places));
            }
        }
    }

    fn viewport(&mut self, [width, height]: [f64; 2], spans: &[Span]) {
        let most = f64::from(u32::MAX);
        for (number, span) in [width, height].into_iter().zip(spans) {
            if most < number {
                self.report.error(|| {
                    let message = format!("viewport: must be {most} at most");
                    Diagnostic::error(*span, message, "a whole number, 1 or more")
                });
                return;
            }
        }
        self.camera.viewport = Some(Size {
            width: width as u32,
            height: height as u32,
        });
    }

    /// The camera: what the records say, and defaults for those that are missing.
    pub(super) fn camera(&mut self, objects: &[Object]) -> Camera {
        let view = self.origins.view;
        for (place, word) in view.iter().zip(["camera", "resolution", "viewport"]) {
            if place.is_none() {
                self.report.warning(|| missing(word));
            }
        }
        let Said {
            camera,
            resolution,
            viewport,
        } = std::mem::take(&mut self.camera);
        let size = viewport.unwrap_or(DEFAULT_SIZE);
        let rows = f64::from(size.height);
        let half_angle = (0.5 * DEFAULT_ANGLE).to_radians();
        let box_around = || bounds(objects.iter());
        let Some((said, places)) = camera else {
            let (eye, target) = default_eye_and_target(box_around(), DEFAULT_ANGLE, DEFAULT_SIDE);
            let extent = 2.0 * libm::tan(half_angle);
            self.origins.resolution = resolution.unwrap_or([extent / rows; 2]);
            self.origins.focal = self.origins.resolution[1] * rows / extent;
            let camera = Camera {
                eye,
                target,
                up: DVec3::Z,
                lens: Lens::Perspective(DEFAULT_ANGLE),
                pixel_aspect: shape_of(self.origins.resolution),
                depths: Camera::ALL_DEPTHS,
                focus: Focus::PINHOLE,
                size,
            };
            let places = Places {
                remedy: REMEDY,
                ..Places::default()
            };
            self.check_lens(&camera);
            check(&camera, &places, &mut self.report);
            return camera;
        };
        let [eye, target, up] = said.points;
        let [focal, near, far, ..] = said.numbers;
        let is_perspective = said.choices[0] == 0;
        let resolution = resolution.unwrap_or_else(|| {
            let height = if is_perspective {
                2.0 * focal * libm::tan(half_angle)
            } else {
                height_of(box_around())
            };
            [height / rows; 2]
        });
        let height = resolution[1] * rows;
        self.origins.resolution = resolution;
        self.origins.focal = focal;
        let camera = Camera {
            eye,
            target,
            up,
            lens: if is_perspective {
                Lens::Perspective(2.0 * libm::atan(0.5 * height / focal).to_degrees())
            } else {
                Lens::Orthographic(height)
            },
            pixel_aspect: shape_of(resolution),
            depths: [near.max(0.0), far],
            focus: Focus::PINHOLE,
            size,
        };
        self.check_lens(&camera);
        check(&camera, &places, &mut self.report);
        camera
    }

    /// Reports numbers so far apart that no ray can be computed with them.
    fn check_lens(&mut self, camera: &Camera) {
        let is_lens = match camera.lens {
            Lens::Perspective(angle) => 0.0 < angle && angle < 180.0,
            Lens::Orthographic(height) => 0.0 < height && height.is_finite(),
        };
        let width = camera.pixel_aspect * f64::from(camera.size.width);
        if is_lens && 0.0 < width && width.is_finite() {
            return;
        }
        let [camera, resolution, _] = self.origins.view;
        let place = resolution.or(camera);
        let place = place.map_or_else(|| Span::at(0), |record| self.tree.span_of(record));
        self.report.error(|| {
            let message = "resolution: too large or too small beside the focal length";
            Diagnostic::error(
                place,
                message,
                "a view with an angle above 0° and below 180°",
            )
        });
    }
}

/// The width of a pixel over its height.
fn shape_of([across, up]: [f64; 2]) -> f64 {
    across / up
}

/// The height of an orthographic view that shows a sphere around the box.
fn height_of(bounds: Aabb) -> f64 {
    let diagonal = bounds.size().length();
    if diagonal.is_finite() && 0.0 < diagonal {
        diagonal
    } else {
        1.0
    }
}

fn missing(word: &str) -> Diagnostic {
    let otherwise = match word {
        "camera" => "a view of the whole scene stands in",
        "resolution" => "the picture shows the whole scene",
        _ => "the picture has 800 × 600 pixels",
    };
    let message = format!("{word}: there is no such record");
    Diagnostic::warning(Span::at(0), message, format!("a `{word}` record")).with_hint(otherwise)
}
