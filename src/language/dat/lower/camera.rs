//! The camera, from three records or defaults for those that are missing.

use glam::DVec3;

use super::Lowering;
use crate::camera::{CameraSpans, check, default_eye_and_target};
use crate::dat::schema::{RESOLUTION, SCHEMA, VIEWPORT};
use crate::dat::view::{self, View};
use crate::engine::reader::Reading;
use geometry::Aabb;
use scene::{Camera, Lens, Object, Size, bounds};
use text::{Diagnostic, Span};

/// The direction of the default eye from the centre of the scene.
const DEFAULT_SIDE: DVec3 = DVec3::new(0.4, -1.0, 0.3);

/// Default vertical angle of view, in degrees.
const DEFAULT_ANGLE: f64 = 45.0;

/// How to state a camera.
const REMEDY: &str = "add a camera: camera perspective eye look up focal near far";

/// The valid records of the camera.
#[derive(Default)]
pub(super) struct Records {
    camera: Option<(View, CameraSpans)>,
    resolution: Option<[f64; 2]>,
    viewport: Option<Size>,
}

impl Lowering<'_> {
    pub(super) fn view(&mut self, read: &Reading<'_>) {
        let Some(numbers) = read.numbers() else {
            return;
        };
        if *read.record == RESOLUTION {
            let at = const { RESOLUTION.at("resolution") };
            self.camera.resolution = Some(at.get(numbers));
        } else if *read.record == VIEWPORT {
            let at = const { VIEWPORT.at("viewport") };
            self.viewport(at.get(numbers), &read.spans);
        } else {
            let spans = &read.spans;
            let view = View::from_camera_record(numbers);
            let [near, far] = view.depths;
            let near = near.max(0.0);
            if far <= near {
                self.reader.report.error(|| {
                    let message = "camera far: must be greater than near";
                    let expected = format!("a number greater than {near}");
                    Diagnostic::error(view::FAR.span(spans), message, expected)
                });
            }
            let places = CameraSpans {
                eye: view::EYE.span(spans),
                target: view::LOOK.span(spans),
                up: view::UP.span(spans),
                whole: spans[0].to(spans[spans.len() - 1]),
                remedy: REMEDY,
            };
            self.camera.camera = Some((view, places));
        }
    }

    fn viewport(&mut self, sides: [f64; 2], spans: &[Span]) {
        let most = f64::from(u32::MAX);
        let over = sides.iter().zip(spans).find(|(side, _)| most < **side);
        if let Some((_, span)) = over {
            self.reader.report.error(|| {
                let message = format!("viewport: must be {most} at most");
                Diagnostic::error(*span, message, "a whole number, 1 or more")
            });
            return;
        }
        self.camera.viewport = Some(view::size(sides));
    }

    /// The camera of the records, with defaults for missing ones.
    pub(super) fn camera(&mut self, objects: &[Object]) -> Camera {
        let view = self.reader.places.view.iter().zip(SCHEMA.view());
        for (_, record) in view.filter(|(place, _)| place.is_none()) {
            self.reader.report.warning(|| missing(record.name));
        }
        let Records {
            camera,
            resolution,
            viewport,
        } = std::mem::take(&mut self.camera);
        let size = viewport.unwrap_or(view::DEFAULT_SIZE);
        let rows = f64::from(size.height);
        let half_angle = (0.5 * DEFAULT_ANGLE).to_radians();
        let box_around = || bounds(objects.iter());
        let Some((view, places)) = camera else {
            let (eye, target) = default_eye_and_target(box_around(), DEFAULT_ANGLE, DEFAULT_SIDE);
            let extent = 2.0 * libm::tan(half_angle);
            self.reader.places.own.resolution = resolution.unwrap_or([extent / rows; 2]);
            self.reader.places.own.focal = self.reader.places.own.resolution[1] * rows / extent;
            let view = View {
                is_perspective: true,
                eye,
                look: target,
                up: DVec3::Z,
                focal: self.reader.places.own.focal,
                depths: Camera::ALL_DEPTHS,
                resolution: self.reader.places.own.resolution,
                size,
            };
            let camera = Camera {
                lens: Lens::Perspective(DEFAULT_ANGLE),
                ..view.camera()
            };
            let places = CameraSpans {
                remedy: REMEDY,
                ..CameraSpans::default()
            };
            self.check_lens(&camera);
            check(&camera, &places, &mut self.reader.report);
            return camera;
        };
        let resolution = resolution.unwrap_or_else(|| {
            let height = if view.is_perspective {
                2.0 * view.focal * libm::tan(half_angle)
            } else {
                height_of(box_around())
            };
            [height / rows; 2]
        });
        self.reader.places.own.resolution = resolution;
        self.reader.places.own.focal = view.focal;
        let camera = View {
            resolution,
            size,
            ..view
        }
        .camera();
        self.check_lens(&camera);
        check(&camera, &places, &mut self.reader.report);
        camera
    }

    /// Reports numbers too far apart to compute rays with.
    fn check_lens(&mut self, camera: &Camera) {
        let is_lens = match camera.lens {
            Lens::Perspective(angle) => 0.0 < angle && angle < 180.0,
            Lens::Orthographic(height) => 0.0 < height && height.is_finite(),
        };
        let width = camera.pixel_aspect * f64::from(camera.size.width);
        if is_lens && 0.0 < width && width.is_finite() {
            return;
        }
        let view = &self.reader.places.view;
        let place = view[1].or(view[0]);
        let place = place.map_or_else(|| Span::at(0), |record| self.reader.lines.span(record));
        self.reader.report.error(|| {
            let message = "resolution: too large or too small for the focal length";
            Diagnostic::error(
                place,
                message,
                "a view with an angle above 0° and below 180°",
            )
        });
    }
}

/// The height of an orthographic view that contains the bounding sphere of the box.
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
        "camera" => "the default view shows the whole scene",
        "resolution" => "the picture shows the whole scene",
        _ => "the picture has 800 × 600 pixels",
    };
    let message = format!("no `{word}` record");
    Diagnostic::warning(Span::at(0), message, format!("a `{word}` record")).with_hint(otherwise)
}
