//! What each action does to a `.ray` text.

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

/// Parts of [`TEXT`], and changes of it, by the names that rows give them in braces.
pub(super) const NAMES: &str = r"
    ball  | sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n
    box   | box 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n
    red   | -5 5 5  1 0 0\n
    three | -5 5 5  1 0 0\n2\n => -5 5 5  1 0 0\n3\n
    four  | -5 5 5  1 0 0\n2\n => -5 5 5  1 0 0\n4\n
    grey  | 0 0 0  .5 .5 .5  0 0 0  1  0  0  1\n
";

pub(super) const ROWS: &str = r"
    add sphere | object 1 | asphere<Enter> | {three} & {ball} +> sphere  0 0 0  2  {grey}
    add ellipsoid | object 1 | aellipsoid<Enter> | {three} & {ball} +> ellipsoid  0 0 0  1 0 0  0 1 0  0 0 1  2  2  2  {grey}
    add box | object 1 | abox<Enter> | {three} & {ball} +> box  -2 -2 -2  1 0 0  0 1 0  0 0 1  4  4  4  {grey}
    add cylinder | object 1 | acylinder<Enter> | {three} & {ball} +> cylinder  0 -2 0  0 0 1  1 0 0  0 1 0  2  2  4  {grey}
    add cone | object 1 | acone<Enter> | {three} & {ball} +> cone  0 -2 0  0 0 1  1 0 0  0 1 0  2  2  4  {grey}
    add light | object 1 | alight<Enter> | 2\n => 3\n & {red} +> 0 8 0  1 1 1\n
    delete | object 1 | d | 2\n// ball\n{ball} => 1\n// ball\n
    delete | light 2 | d | 2\n => 1\n & {red} =>
    delete | object 1 | <Space><Space>d | says the last object cannot be deleted: a .ray scene needs at least one
    delete | view | d | says view cannot be copied, moved or deleted
    duplicate | object 1 | D | {three} & // ball\n => // ball\n{ball}
    duplicate | light 1 | D | 2\n => 3\n5 5 5  1 1 1 // lamp\n
    duplicate | object 1 | <Space><Space>D | {four} & {box} +> {ball}{box}
    reorder-up | object 2 | K | // ball\n => // ball\n{box} & {ball}{box} => {ball}
    reorder-down | object 1 | J | // ball\n => // ball\n{box} & {ball}{box} => {ball}
    reorder-down | light 1 | J | 2\n => 2\n{red} & 5 5 5  1 1 1 // lamp\n{red} => 5 5 5  1 1 1 // lamp\n
    reorder-up | object 1 | K | says object 1 (sphere) is already the first
    paste | object 1 | yjp | {three} & {box} +> {ball}
    paste | object 1 | <Space><Space>yp | {four} & {box} +> {ball}{box}
    paste | object 1 | p | says nothing to paste: y copies the selected item
    rename | object 1 | Rmoon<Enter> | {ball} => sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1 // moon\n
    rename | light 1 | R<Ctrl-u>old sun<Enter> | // lamp => // old sun
    rename | light 1 | R<Ctrl-u><Enter> | \s// lamp =>
    rename | light 1 | R<Ctrl-u>view: here<Enter> | says a comment that begins with view: would set the view
    rename | view | R | says view has no name
    visibility | object 1 | h | says .ray cannot hide objects
    visibility | object 1 | <Space><Space>h | says .ray cannot hide objects
    change-type | object 1 | cellipsoid<Enter> | sphere 0 0 0\s => ellipsoid  0 0 0  1 0 0  0 1 0  0 0 1  1  1 \s
    change-type | object 2 | ccyl<Enter>
        | box 2 0 0  1 0 0  0 1 0  0 0 1  1 2\s => cylinder  2.5 1 0  1 0 0  0 1 0  0 0 1  0.5  1 \s
    change-type | light 1 | c | says light 1 has only one type
    move | object 1 | mx2<Enter> | sphere 0\s => sphere 2\s
    move | object 1 | <Space><Space>my1<Enter>
        | {ball}{box} => sphere 0 1 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 2 1 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n
    move | light 1 | mz-5<Enter> | 5 5 5\s => 5 5 0\s
    move | object 1 | ml<Enter> | sphere 0\s => sphere 0.5\s
    move | view | m | says v moves the camera
    rotate | object 2 | tz90<Enter> | 2 0 0  1 0 0  0 1\s => 3.5 0.5 0  0 1 0  -1 0\s
    rotate | object 1 | <Space><Space>tz90<Enter>
        | {ball}{box} => sphere 3.5 -1.5 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 3.5 0.5 0  0 1 0  -1 0 0  0 0 1  1 2 3  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n
    scale | object 1 | s2<Enter> | 0 0 1\s => 0 0 2\s
    scale | object 2 | syy2<Enter> | 0 0  1 0 0  0 1 0  0 0 1  1 2\s => -1 0  1 0 0  0 1 0  0 0 1  1 4\s
    scale | object 1 | <Space><Space>s2<Enter>
        | {ball}{box} => sphere -2.5 -1 -1.5 2  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\nbox 1.5 -1 -1.5  1 0 0  0 1 0  0 0 1  2 4 6  0 0 0 .5 .4 .3 0 0 0 1 0 0 1\n
    nudge-up | object 1 | el | sphere 0\s => sphere 0.1\s
    nudge-down | object 1 | eh | sphere 0\s => sphere -0.1\s
    nudge-up-coarse | object 1 | eL | sphere 0\s => sphere 1\s
    nudge-down-coarse | object 1 | eH | sphere 0\s => sphere -1\s
    nudge-up-fine | object 1 | e<Alt-l> | sphere 0\s => sphere 0.01\s
    nudge-down-fine | object 1 | e<Alt-h> | sphere 0\s => sphere -0.01\s
    type | object 1 | ej3<Enter> | 0 0 1\s => 0 0 3\s
    type | object 1 | ej<Enter><Ctrl-u>1/4<Enter> | 0 0 1\s => 0 0 0.25\s
    type | object 1 | ej+=1<Enter> | 0 0 1\s => 0 0 2\s
    type | object 1 | <Space><Space>kejjj.2<Enter>
        | {ball}{box} => sphere 0 0 0 1  0 0 0 .2 .5 .5 0 0 0 1 0 0 1\nbox 2 0 0  1 0 0  0 1 0  0 0 1  1 2 3  0 0 0 .2 .4 .3 0 0 0 1 0 0 1\n
    choose | object 1 | ej<Enter><Ctrl-u>4<Enter> | 0 0 1\s => 0 0 4\s
    pick-colour | object 2 | ejjjjjjjjcjjL<Enter> | .5 .4 .3 => .7 .56 .42
    orthonormalise | object 1 | eO | says object 1 (sphere) has no frame to orthonormalise
    orthonormalise | object 2 | eO | says object 2 (box) is already orthonormal
    :mesh | object 1 | :mesh a.obj<Enter> | says there are no meshes in this language
    write-view | object 1 | vlS | 0 0 10\s => 0.8716 0 9.9619\s
    write-view | object 1 | vlqS<Esc> | 0 0 10\s => 0.8716 0 9.9619\s
    :view save | object 1 | :view save side<Enter> | {box} +> // view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 90\n
    :view save | object 1 | vl:view save<Enter> | 0 0 10\s => 0.8716 0 9.9619\s
    :size | object 1 | :size 320x200<Enter> | 400 300\n => 320 200\n
    cure | object 1 | C | says no suggestion for this scene
    :set | object 1 | :set depth 3<Enter> | // view: eye => // render: depth 3\n// view: eye
    delete-view | object 1 | vVd<Esc> | // view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60\n =>
";
