//! Zooming and panning, regions, pauses, and the ends of traces.

use std::sync::Arc;

use super::scripts::{Session, Stage, ray, scripts};
use super::*;
use crate::app::display;
use crate::msg::Target;

/// The stage of the full-size trace on screen.
fn tracing<'s>() -> Stage<'s> {
    ray().after("ggj<F5> | does recall | > @started full 1")
}

scripts! {
    a_trace_ends_in_the_mode_that_it_was_called_from: ray().table(r"
        {1}   | mode {2}
        <F5>  | mode TRACE
        <Esc> | mode {2}
    ", r"
        j  | SELECT
        e  | EDIT
        v  | VIEW
        vF | VIEW FLY
    ");

    keys_zoom_about_the_middle_and_the_wheel_about_the_pointer: for (stage, [across, down], steps) in [
        (tracing(), [2, 2], ["+++++", "--"]),
        (tracing(), [3, 3], ["@wheel picture {1}", "@wheel picture {1}"]),
        (ray(), [3, 3], ["@wheel picture {1} ctrl", "@wheel picture {1} ctrl"]),
    ] {
        let mut session = stage.session();
        let (cells, _) = session.app.shared.raster().expect("room");
        let (column, row) = (cells.width / across, cells.height / down);
        let under = |session: &Session| {
            let window = display::frame_window(&session.app.shared)?;
            window.pixel_at((column, row), session.app.shared.output())
        };
        let before = under(&session).expect("a pixel");
        for step in steps {
            let step = step.replace("{1}", &format!("{column},{row}"));
            session.run(&format!("{step} | zoomed"));
            let after = under(&session).expect("a pixel");
            // A pixel of the screen was several of the picture before.
            let near = |axis: usize| before[axis].abs_diff(after[axis]) <= 8;
            assert!(near(0) && near(1), "{step}: {before:?} {after:?}");
        }
    };

    a_trace_is_paused_and_continued: tracing().play(r"
        <Space>  | does only pause full | paused
        <Space>  | does only resume full | not paused
        <Space>  | does only pause full | paused
        <F5>     | does only resume full | not paused
        <Space>x | does only pause full, halt full | not paused
        <Space>  | does trace full
        @started full 2
        @frame full 2
        <Space>  | not does | says the trace is already finished
    ");

    /// Scripts wait for pictures; one that is paused would never come.
    a_paused_trace_is_not_awaited: ray().play(r"
        @started preview 1
        @frame preview
        <F5>
        @started full 1
        | unfinished
        <Space> | not unfinished
    ");

    a_running_trace_continues_to_another_end: ray().play(r"
        :until<Enter>            | not does | says the full-size trace ends at 4 spp
        :until 256 spp<Enter>    | not does
        <F5>                     | does recall | job spp 256 limit none
        @started full 1
        :until 16 spp<Enter>     | does trace full | job spp 16 limit none
        :until 30 s<Enter>       | does trace full | job spp 65536 limit Time(30s)
        :until noise 0.01<Enter> | does trace full | job spp 65536 limit Noise(0.01)
        :export a.png<Enter>     | does trace export | job spp 4 limit none
    ");

    a_region_is_traced_alone_and_exports_are_of_all_of_the_picture: ray().play(r"
        :region 10,20,64,48<Enter> | does recall | job region 10,20,64,48 | mode TRACE
        @started full 1
        b                          | does trace export | job region none
        :region off<Enter>         | does trace full | job region none
        :region 9999,0,1,1<Enter>  | not does | says …reaches outside the picture…
        // The middle half of all of the picture.
        R<Enter>                   | does trace full | job region 200,150,401,301
        Rh<Tab>LJ<Esc>             | not does | mode TRACE | context In(Trace)
    ");

    corners_of_a_region_are_moved_by_pixels_of_the_screen: tracing().play(r"
        +++++R   | drawn 393,295,14,11
        lJ<Tab>h | drawn 392,295,16,19
    ");

    // At 1:1 a cell shows one pixel across and two down.
    a_region_is_dragged_with_the_mouse: tracing().play(r"
        z  | top-left 350,262
        R
        @down picture 9,9
        @drag picture 4,7
        @up picture 4,7 | does trace full | job region 354,276,6,5
    ");

    a_zoomed_preview_is_traced_at_its_scale: ray().play(r"
        :zoom 1:2<Enter> | does trace preview | job size 400x300 region 157,118,87,65
        :zoom 1:1<Enter> | does trace preview | job size 800x600 region 357,268,87,65
        :zoom 8<Enter>   | does trace preview | job size 800x600 region 395,296,11,9
        :zoom fit<Enter> | does trace preview | job size 87x65 region none
        :zoom 3<Enter>   | not does | says …a power of two…
    ");

    a_zoomed_trace_is_panned_by_keys_and_by_dragging: tracing().play(r"
        z  | top-left 350,262
        lj | top-left 362,272
        @down picture 20,10
        @drag picture 17,11 | top-left 365,270 | mode TRACE
        z  | not zoomed
    ");

    /// The objects under the pixels on screen are those of the part that is seen.
    cells_find_the_pixels_of_the_newest_frame: {
        let mut session = tracing().session();
        let size = session.app.shared.output();
        let numbers: Vec<_> = (0..size.pixels() as u32).collect();
        session.update(Msg::Frame(Target::Trace, Arc::new(frame_of(size, numbers))));
        session.run("+++++++");
        let shared = &mut session.app.shared;
        let window = display::frame_window(shared).expect("room");
        shared.picture_mut().advance(&window, &[], usize::MAX);
        let (cells, _) = shared.raster().expect("room");
        for cell in [(0, 0), (9, 4), (cells.width - 1, cells.height - 1)] {
            let Some([x, y]) = display::pixel_at(shared, cell) else {
                continue;
            };
            let row = u32::from(cell.1 * window.grid.down);
            let under = shared.picture().shown.object_at(cell.0.into(), row);
            assert_eq!(under, Some(y * size.width + x), "{cell:?}");
        }
    };
}
