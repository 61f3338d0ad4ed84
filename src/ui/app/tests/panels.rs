//! The sizes of the panels and of the picture.

use super::scripts::{listed, ray, scripts};

scripts! {
    keys_and_mouse_resize_the_panels: ray().play(r"
        | panels 87,…
        {  | panels 85,…
        }} | panels 89,…
        @down screen 89,9
        @drag screen 60,3 | panels 60,…
        @up screen 60,3
        // It was let go.
        @drag screen 50,3 | panels 60,…
        z{{               | says there are no panels to resize here
        z                 | panels 60,…
    ");

    keys_and_mouse_divide_list_and_fields_and_the_sizes_are_kept: ray().play(r"
        <Alt-}>           | panels …,17 | does keep panels
        <Alt-{><Alt-{>    | panels …,15
        @down screen 90,15
        @drag screen 90,12 | not does keep panels
        @up screen 90,12   | panels …,12 | does keep panels
        j                 | not does keep panels
    ");

    a_page_of_the_list_keeps_a_row_of_the_one_before: {
        let sphere = "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
        listed(&format!("0 0 0  0  99\n{}", sphere.repeat(99))).play(r"
            G          | at object 99
            <PageUp>   | at object 77
            <PageUp>   | at object 55
            <PageDown> | at object 77
        ");
    };

    /// Below the title: render, view, ambient, a heading, light 1, a heading, object 1.
    a_click_selects_the_node_on_its_line_and_headings_take_none: ray().play(r"
        @down list 3,7  | at object 1
        @down list 3,6  | at object 1
        @down list 3,5  | at light 1
        @down list 3,4  | at light 1
        @down list 3,3  | at ambient
        @down list 3,40 | at ambient
    ");

    errors_take_lines_from_the_picture_and_return_them: {
        let mut session = ray().session();
        session.run("@resize 80 24");
        let before = session.app.shared.raster();
        session.run("@file twice 1.5 => -1.5 | errors 1");
        let app = &session.app;
        let areas = app.shared.areas();
        let (smaller, less) = app.shared.raster().expect("there is room");
        assert!(less.pixels() < before.expect("there is room").1.pixels());
        assert!(smaller.bottom() <= areas.errors.y);
        let panel = app.shared.errors_panel(areas.errors).expect("an error");
        assert_eq!(panel.area, areas.errors);
        assert_eq!(app.shared.pictures.preview.asked, Some((less, None)));
        session.run("@file opened");
        assert_eq!(session.app.shared.raster(), before);
    };
}
