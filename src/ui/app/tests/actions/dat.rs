//! What each action does to a `.dat` text.

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

/// Parts of [`TEXT`], and changes of it, by the names that rows give them in braces.
pub(super) const NAMES: &str = r"
    ball    | obj sphere ID 1 mat ID 1  0 0 0  1\n
    other   | obj sphere ID 2 mat ID 2  3 0 0  2\n
    lamp    | light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\n
    sky     | light ID 2 amb  0 0 0  0 0 0  .5 .5 .5  1 0 0  0  shadow_off\n
    white   | mat ID 1  1 1 1  .3 .5 .2 9  0 0 1\n
    red     | mat ID 2  1 0 0  .3 .5 .2 9  0 0 1\n
    checker | texture ID 1 checker 4 4 1 1 1 0 0 0\n
    drawn   | render 2 ID 1 ID 2\n
    three   | 2 ID 1 ID 2\n => 3 ID 1 ID 2 ID 3\n
";

pub(super) const ROWS: &str = r"
    add sphere | object 1 | asphere<Enter> | {ball} +> obj sphere ID 3 mat ID 1  0 0 0  5\n & {three}
    add ellipsoid | object 1 | aellipsoid<Enter> | {ball} +> obj ellipsoid ID 3 mat ID 1  0 0 0  5  5  5\n & {three}
    add cylinder | object 1 | acylinder<Enter> | {ball} +> obj cylinder ID 3 mat ID 1  0 0 0  0 0 1  5  10\n & {three}
    add box | object 1 | abox<Enter> | {ball} +> obj box ID 3 mat ID 1  0 0 0  1 0 0  0 1 0  0 0 1  10  10  10\n & {three}
    add quadric | object 1 | aquadric<Enter> | {ball} +> obj quadric ID 3 mat ID 1  0.04 0 0 0 0.04 0 0 0.04 0 -1  0\n & {three}
    add union | object 1 | <Space><Space>aunion<Enter> | {drawn} => obj CSG ID 3 union ID 1 ID 2\nrender 1 ID 3\n
    add intersection | object 1 | <Space><Space>aintersection<Enter>
        | {drawn} => obj CSG ID 3 intersection ID 1 ID 2\nrender 1 ID 3\n
    add difference | object 1 | <Space><Space>adifference<Enter> | {drawn} => obj CSG ID 3 difference ID 1 ID 2\nrender 1 ID 3\n
    add point light | object 1 | apoint light<Enter> | {sky} +> light ID 3 pnt  0 0 20  0 0 0  1 1 1  1 0 0  0 shadow_on\n
    add spot light | object 1 | aspot light<Enter> | {sky} +> light ID 3 pnt  0 0 20  0 0 -1  1 1 1  1 0 0  10 shadow_on\n
    add distant light | object 1 | adistant light<Enter>
        | {sky} +> light ID 3 inf  0 0 0  0.5 1 -1  0.5 0.5 0.5  1 0 0  0 shadow_on\n
    add ambient light | object 1 | aambient light<Enter> | {sky} +> light ID 3 amb  0 0 0  0 0 0  0.5 0.5 0.5  1 0 0  0 shadow_off\n
    add material | object 1 | amaterial<Enter> | use colour ID 1 mat ID 2\n +> mat ID 3  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n
    add checker texture | object 1 | achecker texture<Enter> | {checker} +> texture ID 2 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2\n
    add image texture | object 1 | aimage texture<Enter> | {checker} +> texture ID 2 image 1 1 picture.png\n
    add union | object 1 | aunion<Enter> | says a union combines two objects: mark them first
    delete | object 1 | d | {ball} => & 2 ID\s =>
    delete | light 2 | d | {sky} =>
    delete | object 1 | <Space><Space>d | says the last drawn object cannot be deleted: `render` would list none, which draws all
    delete | view | d | says view cannot be copied, moved or deleted
    delete | material 1 | dy | {white} => & {ball} => & 2 ID\s =>
    delete | texture 1 | dy | {checker}use colour ID 1 mat ID 2\n =>
    duplicate | object 1 | D | {ball} +> obj sphere ID 3 mat ID 1  0 0 0  1\n & {three}
    duplicate | light 1 | D | {lamp} +> light ID 3 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0  shadow_on\n
    duplicate | object 1 | <Space><Space>D
        | {drawn} => obj sphere ID 3 mat ID 1  0 0 0  1\nobj sphere ID 4 mat ID 2  3 0 0  2\nrender 4 ID 1 ID 2 ID 3 ID 4\n
    duplicate | material 1 | D | {white} +> mat ID 3  1 1 1  .3 .5 .2 9  0 0 1\n
    duplicate | texture 1 | D | {checker} +> texture ID 2 checker 4 4 1 1 1 0 0 0\n
    reorder-up | object 2 | K | # ball\n => # ball\n{other} & {ball}{other} => {ball}
    reorder-down | object 1 | J | # ball\n => # ball\n{other} & {ball}{other} => {ball}
    reorder-down | light 1 | J | viewport 400 300\n +> {sky} & {lamp}{sky} => {lamp}
    reorder-up | object 1 | K | says object 1 (sphere) is already the first
    reorder-down | material 1 | J | {sky} +> {red} & {white}{red} => {white}
    paste | object 1 | yjp | {drawn} => obj sphere ID 3 mat ID 1  0 0 0  1\nrender 3 ID 1 ID 2 ID 3\n
    paste | object 1 | <Space><Space>yp
        | {drawn} => obj sphere ID 3 mat ID 1  0 0 0  1\nobj sphere ID 4 mat ID 2  3 0 0  2\nrender 4 ID 1 ID 2 ID 3 ID 4\n
    paste | object 1 | p | says nothing to paste: y copies the selected item
    rename | object 1 | R<Ctrl-u>9<Enter> | sphere ID 1\s => sphere ID 9\s & 2 ID 1\s => 2 ID 9\s
    rename | material 1 | R<Ctrl-u>8<Enter> | mat ID 1\s => mat ID 8\s & mat ID 1\s => mat ID 8\s
    rename | light 1 | R<Ctrl-u>7<Enter> | ID 1\s => ID 7\s
    visibility | object 1 | h | 2 ID\s =>
    visibility | object 1 | <Space><Space>h | says the last visible object cannot be hidden
    change-type | object 1 | cellipsoid<Enter> | sphere ID 1 mat ID 1  0 0 0\s => ellipsoid ID 1 mat ID 1  0 0 0  1  1\s
    change-type | object 2 | cbox<Enter>
        | sphere ID 2 mat ID 2  3 0 0  2\n => box ID 2 mat ID 2  3 0 0  1 0 0  0 1 0  0 0 1  4  4  4\n
    change-type | light 1 | cinf<Enter> | ID 1 pnt => ID 1 inf
    move | object 1 | mx2<Enter> | 1  0\s => 1  2\s
    move | object 1 | <Space><Space>my1<Enter>
        | {ball}{other} => obj sphere ID 1 mat ID 1  0 1 0  1\nobj sphere ID 2 mat ID 2  3 1 0  2\n
    move | light 1 | mz-5<Enter> | 5 5 5\s => 5 5 0\s
    move | object 1 | ml<Enter> | 1  0\s => 1  0.5\s
    move | view | mx1<Enter> | 0 0 10  0 0 0 => 1 0 10  1 0 0
    rotate | object 2 | t | says object 2 (sphere) has no direction
    rotate | object 1 | <Space><Space>tz90<Enter> | 1  0 0\s => 1  3 -3\s
    scale | object 1 | s2<Enter> | 0  1\n => 0  2\n
    scale | object 2 | syy2 | says a sphere has a single radius: change its type to ellipsoid first
    scale | object 1 | <Space><Space>s2<Enter>
        | {ball}{other} => obj sphere ID 1 mat ID 1  -3 0 0  2\nobj sphere ID 2 mat ID 2  3 0 0  4\n
    nudge-up | object 1 | ejjl | 0  1\n => 0  1.1\n
    nudge-down | object 1 | ejjh | 0  1\n => 0  0.9\n
    nudge-up-coarse | object 1 | ejjL | 0  1\n => 0  2\n
    nudge-down-coarse | object 1 | ejjH | says object 1 (sphere) radius: must be greater than 0
    nudge-up-fine | object 1 | ejj<Alt-l> | 0  1\n => 0  1.01\n
    nudge-down-fine | object 1 | ejj<Alt-h> | 0  1\n => 0  0.99\n
    type | object 1 | ejj3<Enter> | 0  1\n => 0  3\n
    type | object 1 | ejj<Enter><Ctrl-u>1/4<Enter> | 0  1\n => 0  0.25\n
    type | object 1 | ejj+=1<Enter> | 0  1\n => 0  2\n
    type | object 1 | <Space><Space>kejj3<Enter>
        | {ball}{other} => obj sphere ID 1 mat ID 1  0 0 0  3\nobj sphere ID 2 mat ID 2  3 0 0  3\n
    word | light 1 | ejjjjjjjj<Enter>shadow_off<Enter> | shadow_on\n => shadow_off\n
    choose | object 1 | e<Enter>2<Enter> | mat ID 1  0 0 0  1\n => mat ID 2  0 0 0  1\n
    choose | object 1 | e<Enter>9<Enter>
        | mat ID 2\n +> mat ID 9  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n & obj sphere ID 1 mat ID 1 => obj sphere ID 1 mat ID 9
    pick-colour | material 2 | ecjjH<Enter> | 1 0 0  .3 => 0.8 0 0  .3
    orthonormalise | object 1 | eO | says object 1 (sphere) has no frame to orthonormalise
    :mesh | object 1 | :mesh a.obj<Enter> | says there are no meshes in this language
    write-view | object 1 | vlS | 0 0 10\s => 0.8716 0 9.9619\s
    write-view | object 1 | vlqS<Esc> | 0 0 10\s => 0.8716 0 9.9619\s
    :view save | object 1 | :view save side<Enter> | {drawn} +> # view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 112.6199\n
    :view save | object 1 | vl:view save<Enter> | 0 0 10\s => 0.8716 0 9.9619\s
    :size | object 1 | :size 320x200<Enter> | 0  1\s => 0  0.666666666666667\s & 400 300\n => 320 200\n
    cure | object 1 | C | says no suggestion for this scene
    :set | object 1 | :set depth 3<Enter> | # view front: => # render: depth 3\n# view front:
    delete-view | object 1 | vVd<Esc> | # view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60\n =>
";
