//! Where picture and panels are on screens and for pictures of all shapes.

use super::*;
use crate::layout::tests::size;
use crate::layout::{contents, field_rows};
use proptest::prelude::*;

const SHAPE: Shape = Shape {
    zoom: Zoom::Panels,
    output: size(800, 600),
    fields: 9,
    lines: 99,
    explains: true,
    panels: PanelSizes {
        beside: None,
        below: None,
        list_height: None,
        list_width: None,
    },
};

fn screen((width, height): (u16, u16)) -> Rect {
    Rect::new(0, 0, width, height)
}

/// The panels by their first letters.
#[test]
fn panels_appear_as_space_permits() {
    for (width, height, panels) in [
        (0, 0, ""),
        (19, 50, ""),
        (200, 5, ""),
        (20, 6, "ps"),
        (39, 50, "ps"),
        (40, 16, "plfhs"),
        (80, 24, "plfhs"),
    ] {
        let all = arrange(screen((width, height)), &SHAPE);
        let areas = [all.picture, all.list, all.fields, all.hint, all.status];
        let named = "plfhs".chars().zip(areas);
        let shown = named.filter(|(_, area)| !area.is_empty());
        let shown: String = shown.map(|(name, _)| name).collect();
        assert_eq!(shown, panels, "{width}×{height}");
    }
}

/// The sizes of picture, list and fields.
#[test]
fn the_shapes_of_picture_and_screen_decide() {
    for (columns_and_rows, output, expected) in table! {
        // Beside: narrow panels if the picture needs the columns, wide ones if it cannot use them.
        (80, 24), size(4, 3) => [(47, 18), (32, 8), (32, 14)];
        (200, 50), size(4, 3) => [(128, 48), (60, 34), (60, 14)];
        (80, 24), size(1, 2) => [(22, 22), (57, 8), (57, 14)];
        // Below: as low as the picture needs, side by side or one above the other.
        (100, 60), size(4, 3) => [(100, 38), (39, 20), (60, 20)];
        (60, 40), size(4, 3) => [(60, 23), (26, 15), (33, 15)];
        (40, 40), size(4, 3) => [(40, 15), (40, 9), (40, 14)];
        (40, 16), size(4, 3) => [(19, 7), (15, 7), (24, 7)];
        (120, 30), size(4, 1) => [(120, 15), (47, 13), (72, 13)];
    } {
        let areas = arrange(screen(columns_and_rows), &Shape { output, ..SHAPE });
        let shown = raster(areas.picture, output).map(|(cells, _)| cells);
        let sizes = [shown.unwrap_or_default(), areas.list, areas.fields];
        let sizes = sizes.map(|area| (area.width, area.height));
        assert_eq!(sizes, expected, "{columns_and_rows:?}");
    }
}

/// The columns and lines of the picture when panels were always beside it from 80×24 on, and
/// took half of a smaller screen.
#[test]
fn no_picture_is_smaller_than_beside_panels_of_fixed_size() {
    for (columns_and_rows, before) in [
        ((80, 24), (44, 22)),
        ((120, 40), (83, 38)),
        ((200, 50), (155, 48)),
        ((100, 60), (64, 58)),
        ((60, 40), (60, 18)),
    ] {
        let areas = arrange(screen(columns_and_rows), &SHAPE);
        let cells = |area| raster(area, SHAPE.output).map_or(0, |(cells, _)| cells.area());
        let before = cells(screen(before));
        assert!(before <= cells(areas.picture), "{columns_and_rows:?}");
    }
}

#[test]
fn the_list_gets_the_lines_that_fields_do_not_need() {
    let heights = |height, fields| {
        let shape = Shape { fields, ..SHAPE };
        let areas = arrange(screen((160, height)), &shape);
        (areas.list.height, areas.fields.height)
    };
    // Two of sixty lines are bars; the fields take a title, their lines and four lines of
    // notes.
    assert_eq!(heights(60, 14), (39, 19));
    assert_eq!(heights(60, 10), (43, 15));
    assert_eq!(heights(60, 1), heights(60, 2));
    assert_eq!(heights(24, 14), (7, 15));
}

#[test]
fn panels_are_resized_within_limits_and_keep_their_sizes() {
    for area in [(120, 40), (60, 60)].map(screen) {
        let size = |shape: &Shape| {
            let areas = arrange(area, shape);
            (areas.list.width, areas.fields.bottom() - areas.list.y)
        };
        let mut shape = SHAPE;
        let before = size(&shape);
        let step = |shape: &mut Shape, cells| {
            let areas = arrange(area, shape);
            shape.panels = resized(&areas, shape, cells).expect("there are panels");
        };
        step(&mut shape, 2);
        assert_ne!(size(&shape), before);
        step(&mut shape, -2);
        assert_eq!(size(&shape), before);
        for cells in [-999, 999] {
            step(&mut shape, cells);
            let limit = size(&shape);
            step(&mut shape, cells);
            assert_eq!(size(&shape), limit, "nothing to undo first");
            assert!(!arrange(area, &shape).picture.is_empty());
        }
    }
    let shape = Shape {
        zoom: Zoom::Picture,
        ..SHAPE
    };
    let areas = arrange(screen((120, 40)), &shape);
    assert_eq!(resized(&areas, &shape, 2), None);
}

#[test]
fn a_dragged_border_follows_the_pointer() {
    for (columns_and_rows, at) in [((120, 40), (70, 9)), ((60, 60), (9, 30))] {
        let area = screen(columns_and_rows);
        let areas = arrange(area, &SHAPE);
        let panels = resized(&areas, &SHAPE, areas.dragged(at)).expect("there are panels");
        let areas = arrange(area, &Shape { panels, ..SHAPE });
        assert!(areas.border.contains(at.into()), "{area:?}: {areas:?}");
    }
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn areas_are_inside_the_screen_and_disjoint(
        x in 0u16..5, y in 0u16..5, width in 0u16..220, height in 0u16..90, alone: bool,
        fields in 0usize..40, lines in 0usize..90, explains: bool, output in (1u32..2000, 1u32..2000), errors in 0u16..20,
        beside: Option<u16>, below: Option<u16>,
        list_height: Option<u16>, list_width: Option<u16>
    ) {
        let area = Rect::new(x, y, width, height);
        let shape = Shape {
            zoom: if alone { Zoom::Picture } else { Zoom::Panels },
            output: size(output.0, output.1),
            fields,
            lines,
            explains,
            panels: PanelSizes { beside, below, list_height, list_width },
        };
        let all = arrange(area, &shape);
        prop_assert!(all.room_for_errors().height <= all.picture.height);
        let all = all.make_room(errors);
        let panels = [
            all.picture, all.rule, all.list, all.fields, all.hint, all.status, all.errors,
        ];
        for (at, panel) in panels.iter().enumerate() {
            prop_assert_eq!(panel.intersection(area).area(), panel.area());
            for other in &panels[at + 1..] {
                prop_assert!(panel.intersection(*other).is_empty());
            }
        }
        prop_assert_eq!(all.border.intersection(area).area(), all.border.area());
        let divider = all.divider();
        prop_assert_eq!(divider.intersection(area).area(), divider.area());
    }

    #[test]
    fn panels_are_usable_wherever_they_are(
        width in 40u16..220, height in 24u16..90, output in (1u32..2000, 1u32..2000),
    ) {
        let shape = Shape { output: size(output.0, output.1), ..SHAPE };
        let all = arrange(screen((width, height)), &shape);
        prop_assert!(8 <= field_rows(all.fields, true).height, "{all:?}");
        prop_assert!(3 <= contents(all.list).height, "{all:?}");
        prop_assert!(59 > width || 26 <= all.list.width, "{all:?}");
    }
}
