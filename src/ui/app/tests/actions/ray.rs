//! What each action does to a `.ray` text.

use super::*;

pub(super) const TEXT: &str = "\
// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 90 size 400 300
// view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60
0.1 0.1 0.1
2
5 5 5  1 1 1 // lamp
-5 5 5  1 0 0
2
// ball
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1
";

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row(Add("sphere"), Object(0), "asphere<Enter>", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nsphere  0 0 0  2  0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n"),
    ])),
    row(Add("ellipsoid"), Object(0), "aellipsoid<Enter>", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nellipsoid  0 0 0  1 0 0  0 1 0  0 0 1  2  2  2  0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n"),
    ])),
    row(Add("box"), Object(0), "abox<Enter>", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox  -2 -2 -2  1 0 0  0 1 0  0 0 1  4  4  4  0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n"),
    ])),
    row(Add("cylinder"), Object(0), "acylinder<Enter>", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\ncylinder  0 -2 0  0 0 1  1 0 0  0 1 0  2  2  4  0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n"),
    ])),
    row(Add("cone"), Object(0), "acone<Enter>", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\ncone  0 -2 0  0 0 1  1 0 0  0 1 0  2  2  4  0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n"),
    ])),
    row(Add("light"), Object(0), "alight<Enter>", Becomes(&[
        ("2\n",
            "3\n"),
        ("-5 5 5  1 0 0\n",
            "-5 5 5  1 0 0\n0 8 0  1 1 1\n"),
    ])),
    row(Key("delete"), Object(0), "d", Becomes(&[
        ("2\n// ball\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "1\n// ball\n"),
    ])),
    row(Key("delete"), Light(1), "d", Becomes(&[
        ("2\n",
            "1\n"),
        ("-5 5 5  1 0 0\n",
            ""),
    ])),
    row(Key("delete"), Object(0), "  d", Says("the last object cannot be deleted: a .ray scene needs at least one")),
    row(Key("delete"), View, "d", Says("view cannot be copied, moved or deleted")),
    row(Key("duplicate"), Object(0), "D", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("// ball\n", "// ball\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("duplicate"), Light(0), "D", Becomes(&[
        ("2\n",
            "3\n5 5 5  1 1 1 // lamp\n"),
    ])),
    row(Key("duplicate"), Object(0), "  D", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n4\n"),
        ("box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("reorder-up"), Object(1), "K", Becomes(&[
        ("// ball\n",
            "// ball\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("reorder-down"), Object(0), "J", Becomes(&[
        ("// ball\n",
            "// ball\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("reorder-down"), Light(0), "J", Becomes(&[
        ("2\n",
            "2\n-5 5 5  1 0 0\n"),
        ("5 5 5  1 1 1 // lamp\n-5 5 5  1 0 0\n",
            "5 5 5  1 1 1 // lamp\n"),
    ])),
    row(Key("reorder-up"), Object(0), "K", Says("object 1 (sphere) is already the first")),
    row(Key("paste"), Object(0), "yjp", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n3\n"),
        ("box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("paste"), Object(0), "  yp", Becomes(&[
        ("-5 5 5  1 0 0\n2\n",
            "-5 5 5  1 0 0\n4\n"),
        ("box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("paste"), Object(0), "p", Says("nothing to paste: y copies the selected item")),
    row(Key("rename"), Object(0), "Rmoon<Enter>", Becomes(&[
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1 // moon\n"),
    ])),
    row(Key("rename"), Light(0), "R<Ctrl-u>old sun<Enter>", Becomes(&[
        ("// lamp", "// old sun"),
    ])),
    row(Key("rename"), Light(0), "R<Ctrl-u><Enter>", Becomes(&[
        (" // lamp", ""),
    ])),
    row(Key("rename"), Light(0), "R<Ctrl-u>view: here<Enter>", Says("a comment that begins with view: would set the view")),
    row(Key("rename"), View, "R", Says("view has no name")),
    row(Key("visibility"), Object(0), "h", Says("a .ray scene draws all of its objects")),
    row(Key("visibility"), Object(0), "  h", Says("a .ray scene draws all of its objects")),
    row(Key("change-type"), Object(0), "cellipsoid<Enter>", Becomes(&[
        ("sphere 0 0 0 ",
            "ellipsoid  0 0 0  1 0 0  0 1 0  0 0 1  1  1  "),
    ])),
    row(Key("change-type"), Object(1), "ccyl<Enter>", Becomes(&[
        ("box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 ",
            "cylinder  2.5 1 0  1 0 0  0 1 0  0 0 1  0.5  1  "),
    ])),
    row(Key("change-type"), Light(0), "c", Says("light 1 has only one type")),
    row(Key("move"), Object(0), "mx2<Enter>", Becomes(&[
        ("sphere 0 ",
            "sphere 2 "),
    ])),
    row(Key("move"), Object(0), "  my1<Enter>", Becomes(&[
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere 0 1 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 1 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("move"), Light(0), "mz-5<Enter>", Becomes(&[
        ("5 5 5 ",
            "5 5 0 "),
    ])),
    row(Key("move"), Object(0), "ml<Enter>", Becomes(&[
        ("sphere 0 ",
            "sphere 0.5 "),
    ])),
    row(Key("move"), View, "m", Says("v moves the camera")),
    row(Key("rotate"), Object(1), "tz90<Enter>", Becomes(&[
        ("2 0 0  1 0 0  0 1 ",
            "3.5 0.5 0  0 1 0  -1 0 "),
    ])),
    row(Key("rotate"), Object(0), "  tz90<Enter>", Becomes(&[
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere 3.5 -1.5 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 3.5 0.5 0  0 1 0  -1 0 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("scale"), Object(0), "s2<Enter>", Becomes(&[
        ("0 0 1 ",
            "0 0 2 "),
    ])),
    row(Key("scale"), Object(1), "syy2<Enter>", Becomes(&[
        ("0 0  1 0 0  0 1 0  0 0 1  1 2 ",
            "-1 0  1 0 0  0 1 0  0 0 1  1 4 "),
    ])),
    row(Key("scale"), Object(0), "  s2<Enter>", Becomes(&[
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere -2.5 -1 -1.5 2  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 1.5 -1 -1.5  1 0 0  0 1 0  0 0 1  2 4 6  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("nudge-up"), Object(0), "el", Becomes(&[
        ("sphere 0 ",
            "sphere 0.1 "),
    ])),
    row(Key("nudge-down"), Object(0), "eh", Becomes(&[
        ("sphere 0 ",
            "sphere -0.1 "),
    ])),
    row(Key("nudge-up-coarse"), Object(0), "eL", Becomes(&[
        ("sphere 0 ",
            "sphere 1 "),
    ])),
    row(Key("nudge-down-coarse"), Object(0), "eH", Becomes(&[
        ("sphere 0 ",
            "sphere -1 "),
    ])),
    row(Key("nudge-up-fine"), Object(0), "e<Alt-l>", Becomes(&[
        ("sphere 0 ",
            "sphere 0.01 "),
    ])),
    row(Key("nudge-down-fine"), Object(0), "e<Alt-h>", Becomes(&[
        ("sphere 0 ",
            "sphere -0.01 "),
    ])),
    row(Key("type"), Object(0), "ej3<Enter>", Becomes(&[
        ("0 0 1 ",
            "0 0 3 "),
    ])),
    row(Key("type"), Object(0), "ej<Enter><Ctrl-u>1/4<Enter>", Becomes(&[
        ("0 0 1 ",
            "0 0 0.25 "),
    ])),
    row(Key("type"), Object(0), "ej+=1<Enter>", Becomes(&[
        ("0 0 1 ",
            "0 0 2 "),
    ])),
    row(Key("type"), Object(0), "  kejjj.2<Enter>", Becomes(&[
        ("sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "sphere 0 0 0 1  0 0 0 .2 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .2 .4 .3 0 0 0 1 0 0 1\n"),
    ])),
    row(Key("choose"), Object(0), "ej<Enter><Ctrl-u>4<Enter>", Becomes(&[
        ("0 0 1 ",
            "0 0 4 "),
    ])),
    row(Key("pick-colour"), Object(1), "ejjjjjjjjcjjL<Enter>", Becomes(&[
        (".5 .4 .3",
            ".7 .56 .42"),
    ])),
    row(Key("orthonormalise"), Object(0), "eO", Says("object 1 (sphere) has no frame to orthonormalise")),
    row(Key("orthonormalise"), Object(1), "eO", Says("object 2 (box) is already orthonormal")),
    row(Command("mesh"), Object(0), ":mesh a.obj<Enter>", Says("there are no meshes in this language")),
    row(Key("write-view"), Object(0), "vlS", Becomes(&[
        ("0 0 10 ",
            "0.8716 0 9.9619 "),
    ])),
    row(Key("write-view"), Object(0), "vlqS<Esc>", Becomes(&[
        ("0 0 10 ",
            "0.8716 0 9.9619 "),
    ])),
    row(Command("view save"), Object(0), ":view save side<Enter>", Becomes(&[
        ("box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n",
            "box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n// view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 90\n"),
    ])),
    row(Command("view save"), Object(0), "vl:view save<Enter>", Becomes(&[
        ("0 0 10 ",
            "0.8716 0 9.9619 "),
    ])),
    row(Command("size"), Object(0), ":size 320x200<Enter>", Becomes(&[
        ("400 300\n",
            "320 200\n"),
    ])),
    row(Key("cure"), Object(0), "C", Says("there is no render setting to suggest")),
    row(Command("set"), Object(0), ":set depth 3<Enter>", Becomes(&[
        ("// view: eye",
            "// render: depth 3\n// view: eye"),
    ])),
    row(Key("delete-view"), Object(0), "vVd<Esc>", Becomes(&[
        ("// view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60\n",
            ""),
    ])),
];
