//! What each action does to a `.dat` text.

use super::*;

pub(super) const TEXT: &str = "\
# view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60
camera perspective 0 0 10  0 0 0  0 1 0  1 0 100
resolution 0.01 0.01
viewport 400 300
light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on
light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
texture ID 1 checker 4 4 1 1 1 0 0 0
use colour ID 1 mat ID 2
# ball
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 2  3 0 0  2
render 2 ID 1 ID 2
";

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row(Add("sphere"), Object(0), "asphere<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 3 mat ID 1  0 0 0  5\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Add("ellipsoid"), Object(0), "aellipsoid<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj ellipsoid ID 3 mat ID 1  0 0 0  5  5  5\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Add("cylinder"), Object(0), "acylinder<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj cylinder ID 3 mat ID 1  0 0 0  0 0 1  5  10\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Add("box"), Object(0), "abox<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj box ID 3 mat ID 1  0 0 0  1 0 0  0 1 0  0 0 1  10  10  10\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Add("quadric"), Object(0), "aquadric<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj quadric ID 3 mat ID 1  0.04 0 0 0 0.04 0 0 0.04 0 -1  0\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Add("union"), Object(0), "  aunion<Enter>", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj CSG ID 3 union ID 1 ID 2\nrender 1 ID 3\n"),
    ])),
    row(Add("intersection"), Object(0), "  aintersection<Enter>", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj CSG ID 3 intersection ID 1 ID 2\nrender 1 ID 3\n"),
    ])),
    row(Add("difference"), Object(0), "  adifference<Enter>", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj CSG ID 3 difference ID 1 ID 2\nrender 1 ID 3\n"),
    ])),
    row(Add("point light"), Object(0), "apoint light<Enter>", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\nlight ID 3 pnt  0 0 20  0 0 0  1 1 1  1 0 0  0 shadow_on\n"),
    ])),
    row(Add("spot light"), Object(0), "aspot light<Enter>", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\nlight ID 3 pnt  0 0 20  0 0 -1  1 1 1  1 0 0  10 shadow_on\n"),
    ])),
    row(Add("distant light"), Object(0), "adistant light<Enter>", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\nlight ID 3 inf  0 0 0  0.5 1 -1  0.5 0.5 0.5  1 0 0  0 shadow_on\n"),
    ])),
    row(Add("ambient light"), Object(0), "aambient light<Enter>", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\nlight ID 3 amb  0 0 0  0 0 0  0.5 0.5 0.5  1 0 0  0 shadow_off\n"),
    ])),
    row(Add("material"), Object(0), "amaterial<Enter>", Becomes(&[
        ("use colour ID 1 mat ID 2\n",
            "use colour ID 1 mat ID 2\nmat ID 3  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n"),
    ])),
    row(Add("checker texture"), Object(0), "achecker texture<Enter>", Becomes(&[
        ("texture ID 1 checker 4 4 1 1 1 0 0 0\n",
            "texture ID 1 checker 4 4 1 1 1 0 0 0\ntexture ID 2 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2\n"),
    ])),
    row(Add("image texture"), Object(0), "aimage texture<Enter>", Becomes(&[
        ("texture ID 1 checker 4 4 1 1 1 0 0 0\n",
            "texture ID 1 checker 4 4 1 1 1 0 0 0\ntexture ID 2 image 1 1 picture.png\n"),
    ])),
    row(Add("union"), Object(0), "aunion<Enter>", Says("a union combines two objects: mark them first")),
    row(Key("delete"), Object(0), "d", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            ""),
        ("2 ID ",
            ""),
    ])),
    row(Key("delete"), Light(1), "d", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            ""),
    ])),
    row(Key("delete"), Object(0), "  d", Says("the last drawn object cannot be deleted: `render` would list none, which draws all")),
    row(Key("delete"), View, "d", Says("view cannot be copied, moved or deleted")),
    row(Key("delete"), Material(0), "dy", Becomes(&[
        ("mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n",
            ""),
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            ""),
        ("2 ID ",
            ""),
    ])),
    row(Key("delete"), Texture(0), "dy", Becomes(&[
        ("texture ID 1 checker 4 4 1 1 1 0 0 0\nuse colour ID 1 mat ID 2\n",
            ""),
    ])),
    row(Key("duplicate"), Object(0), "D", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 3 mat ID 1  0 0 0  1\n"),
        ("2 ID 1 ID 2\n",
            "3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Key("duplicate"), Light(0), "D", Becomes(&[
        ("light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\n",
            "light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\nlight ID 3 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\n"),
    ])),
    row(Key("duplicate"), Object(0), "  D", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj sphere ID 3 mat ID 1  0 0 0  1\nobj sphere ID 4 mat ID 2  3 0 0  2\nrender 4 ID 1 ID 2 ID 3 ID 4\n"),
    ])),
    row(Key("duplicate"), Material(0), "D", Becomes(&[
        ("mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n",
            "mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\nmat ID 3  1 1 1  .3 .5 .2 9  0 0 1\n"),
    ])),
    row(Key("duplicate"), Texture(0), "D", Becomes(&[
        ("texture ID 1 checker 4 4 1 1 1 0 0 0\n",
            "texture ID 1 checker 4 4 1 1 1 0 0 0\ntexture ID 2 checker 4 4 1 1 1 0 0 0\n"),
    ])),
    row(Key("reorder-up"), Object(1), "K", Becomes(&[
        ("# ball\n",
            "# ball\nobj sphere ID 2 mat ID 2  3 0 0  2\n"),
        ("obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 2  3 0 0  2\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\n"),
    ])),
    row(Key("reorder-down"), Object(0), "J", Becomes(&[
        ("# ball\n",
            "# ball\nobj sphere ID 2 mat ID 2  3 0 0  2\n"),
        ("obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 2  3 0 0  2\n",
            "obj sphere ID 1 mat ID 1  0 0 0  1\n"),
    ])),
    row(Key("reorder-down"), Light(0), "J", Becomes(&[
        ("viewport 400 300\n",
            "viewport 400 300\nlight ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n"),
        ("light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\nlight ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\n"),
    ])),
    row(Key("reorder-up"), Object(0), "K", Says("object 1 (sphere) is already the first")),
    row(Key("reorder-down"), Material(0), "J", Becomes(&[
        ("light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n",
            "light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\nmat ID 2  1 0 0  .3 .5 .2 9  0 0 1\n"),
        ("mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\nmat ID 2  1 0 0  .3 .5 .2 9  0 0 1\n",
            "mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n"),
    ])),
    row(Key("paste"), Object(0), "yjp", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj sphere ID 3 mat ID 1  0 0 0  1\nrender 3 ID 1 ID 2 ID 3\n"),
    ])),
    row(Key("paste"), Object(0), "  yp", Becomes(&[
        ("render 2 ID 1 ID 2\n",
            "obj sphere ID 3 mat ID 1  0 0 0  1\nobj sphere ID 4 mat ID 2  3 0 0  2\nrender 4 ID 1 ID 2 ID 3 ID 4\n"),
    ])),
    row(Key("paste"), Object(0), "p", Says("nothing to paste: y copies the selected item")),
    row(Key("rename"), Object(0), "R<Ctrl-u>9<Enter>", Becomes(&[
        ("sphere ID 1 ",
            "sphere ID 9 "),
        ("2 ID 1 ",
            "2 ID 9 "),
    ])),
    row(Key("rename"), Material(0), "R<Ctrl-u>8<Enter>", Becomes(&[
        ("mat ID 1 ",
            "mat ID 8 "),
        ("mat ID 1 ",
            "mat ID 8 "),
    ])),
    row(Key("rename"), Light(0), "R<Ctrl-u>7<Enter>", Becomes(&[
        ("ID 1 ",
            "ID 7 "),
    ])),
    row(Key("visibility"), Object(0), "h", Becomes(&[
        ("2 ID ",
            ""),
    ])),
    row(Key("visibility"), Object(0), "  h", Says("the last visible object cannot be hidden")),
    row(Key("change-type"), Object(0), "cellipsoid<Enter>", Becomes(&[
        ("sphere ID 1 mat ID 1  0 0 0 ",
            "ellipsoid ID 1 mat ID 1  0 0 0  1  1 "),
    ])),
    row(Key("change-type"), Object(1), "cbox<Enter>", Becomes(&[
        ("sphere ID 2 mat ID 2  3 0 0  2\n",
            "box ID 2 mat ID 2  3 0 0  1 0 0  0 1 0  0 0 1  4  4  4\n"),
    ])),
    row(Key("change-type"), Light(0), "cinf<Enter>", Becomes(&[
        ("ID 1 pnt", "ID 1 inf"),
    ])),
    row(Key("move"), Object(0), "mx2<Enter>", Becomes(&[
        ("1  0 ",
            "1  2 "),
    ])),
    row(Key("move"), Object(0), "  my1<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 2  3 0 0  2\n",
            "obj sphere ID 1 mat ID 1  0 1 0  1\nobj sphere ID 2 mat ID 2  3 1 0  2\n"),
    ])),
    row(Key("move"), Light(0), "mz-5<Enter>", Becomes(&[
        ("5 5 5 ",
            "5 5 0 "),
    ])),
    row(Key("move"), Object(0), "ml<Enter>", Becomes(&[
        ("1  0 ",
            "1  0.5 "),
    ])),
    row(Key("move"), View, "mx1<Enter>", Becomes(&[
        ("0 0 10  0 0 0", "1 0 10  1 0 0"),
    ])),
    row(Key("rotate"), Object(1), "t", Says("object 2 (sphere) has no direction")),
    row(Key("rotate"), Object(0), "  tz90<Enter>", Becomes(&[
        ("1  0 0 ",
            "1  3 -3 "),
    ])),
    row(Key("scale"), Object(0), "s2<Enter>", Becomes(&[
        ("0  1\n",
            "0  2\n"),
    ])),
    row(Key("scale"), Object(1), "syy2", Says("a sphere has a single radius: change its type to ellipsoid first")),
    row(Key("scale"), Object(0), "  s2<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 2  3 0 0  2\n",
            "obj sphere ID 1 mat ID 1  -3 0 0  2\nobj sphere ID 2 mat ID 2  3 0 0  4\n"),
    ])),
    row(Key("nudge-up"), Object(0), "ejjl", Becomes(&[
        ("0  1\n",
            "0  1.1\n"),
    ])),
    row(Key("nudge-down"), Object(0), "ejjh", Becomes(&[
        ("0  1\n",
            "0  0.9\n"),
    ])),
    row(Key("nudge-up-coarse"), Object(0), "ejjL", Becomes(&[
        ("0  1\n",
            "0  2\n"),
    ])),
    row(Key("nudge-down-coarse"), Object(0), "ejjH", Says("object 1 (sphere) radius: must be greater than 0")),
    row(Key("nudge-up-fine"), Object(0), "ejj<Alt-l>", Becomes(&[
        ("0  1\n",
            "0  1.01\n"),
    ])),
    row(Key("nudge-down-fine"), Object(0), "ejj<Alt-h>", Becomes(&[
        ("0  1\n",
            "0  0.99\n"),
    ])),
    row(Key("type"), Object(0), "ejj3<Enter>", Becomes(&[
        ("0  1\n",
            "0  3\n"),
    ])),
    row(Key("type"), Object(0), "ejj<Enter><Ctrl-u>1/4<Enter>", Becomes(&[
        ("0  1\n",
            "0  0.25\n"),
    ])),
    row(Key("type"), Object(0), "ejj+=1<Enter>", Becomes(&[
        ("0  1\n",
            "0  2\n"),
    ])),
    row(Key("type"), Object(0), "  kejj3<Enter>", Becomes(&[
        ("obj sphere ID 1 mat ID 1  0 0 0  1\nobj sphere ID 2 mat ID 2  3 0 0  2\n",
            "obj sphere ID 1 mat ID 1  0 0 0  3\nobj sphere ID 2 mat ID 2  3 0 0  3\n"),
    ])),
    row(Word, Light(0), "ejjjjjjjj<Enter>shadow_off<Enter>", Becomes(&[
        ("shadow_on\n",
            "shadow_off\n"),
    ])),
    row(Key("choose"), Object(0), "e<Enter>2<Enter>", Becomes(&[
        ("mat ID 1  0 0 0  1\n",
            "mat ID 2  0 0 0  1\n"),
    ])),
    row(Key("choose"), Object(0), "e<Enter>9<Enter>", Becomes(&[
        ("mat ID 2\n", "mat ID 2\nmat ID 9  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n"),
        ("obj sphere ID 1 mat ID 1", "obj sphere ID 1 mat ID 9"),
    ])),
    row(Key("pick-colour"), Material(1), "ecjjH<Enter>", Becomes(&[
        ("1 0 0  .3",
            "0.8 0 0  .3"),
    ])),
    row(Key("orthonormalise"), Object(0), "eO", Says("object 1 (sphere) has no frame to orthonormalise")),
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
        ("render 2 ID 1 ID 2\n",
            "render 2 ID 1 ID 2\n# view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 112.6199\n"),
    ])),
    row(Command("view save"), Object(0), "vl:view save<Enter>", Becomes(&[
        ("0 0 10 ",
            "0.8716 0 9.9619 "),
    ])),
    row(Command("size"), Object(0), ":size 320x200<Enter>", Becomes(&[
        ("0  1 ",
            "0  0.666666666666667 "),
        ("400 300\n",
            "320 200\n"),
    ])),
    row(Key("cure"), Object(0), "C", Says("there is no render setting to suggest")),
    row(Command("set"), Object(0), ":set depth 3<Enter>", Becomes(&[
        ("# view front:",
            "# render: depth 3\n# view front:"),
    ])),
    row(Key("delete-view"), Object(0), "vVd<Esc>", Becomes(&[
        ("# view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60\n",
            ""),
    ])),
];
