//! Modes, and the other contexts with keys of their own: one list each.

/// Declares the modes, one per line in the order of the help: their names in the status line, the
/// names of their sections of keys, and the keys that lead there.
macro_rules! modes {
    ($($(#[$doc:meta])* $mode:ident, $name:literal, $section:literal, $entry:expr;)+) => {
        /// The meaning of the keys, shown in the status line once a scene is open.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Mode {
            $($(#[$doc])* $mode,)+
        }

        impl Mode {
    /// Whether what stands below the list is looked at in it as much as the list.
    pub(crate) fn needs_more_than_the_list(self) -> bool {
        !matches!(self, Self::Select | Self::Move)
    }

            /// All modes, in the order of the help.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$mode),+];

            /// The name of the mode, as in the status line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$mode => $name,)+
                }
            }

            /// The name of its section of keys.
            const fn section(self) -> &'static str {
                match self {
                    $(Self::$mode => $section,)+
                }
            }

            /// The name of the keys that lead to the mode; `None` if several do, each in its way.
            pub(super) const fn entry(self) -> Option<&'static str> {
                match self {
                    $(Self::$mode => $entry,)+
                }
            }
        }
    };
}

modes! {
    /// Selects a node in the list or in the picture.
    Select, "SELECT", "select", Some("list");
    /// Edits the fields of the selected node.
    Edit, "EDIT", "edit", Some("edit");
    /// Moves, rotates or scales things in the picture.
    Move, "MOVE", "move", None;
    /// Moves the camera around its target; the text changes only when the view is saved.
    View, "VIEW", "view", Some("camera");
    /// Flies the camera: turns it in place and moves it with its target.
    Fly, "VIEW FLY", "fly", Some("fly");
    /// Moves a cross over the picture to see what is under it, and why.
    Inspect, "INSPECT", "inspect", Some("inspect");
    /// Shows the full-size trace.
    Trace, "TRACE", "trace", Some("trace");
    /// Compares the picture with a reference.
    Compare, "COMPARE", "compare", Some("compare");
    /// Plays a track and goes to its frames.
    Sequence, "SEQUENCE", "sequence", Some("track");
}

impl Mode {
    /// Whether keys, the wheel and dragging move the camera.
    pub const fn moves_camera(self) -> bool {
        matches!(self, Self::View | Self::Fly)
    }
}

/// Declares the contexts that are no modes, one per line in the order of the help: the names of their
/// sections of keys, and their headings in the help. Pages and questions have keys in common.
macro_rules! contexts {
    (
        { $($(#[$panel_doc:meta])* $panel:ident, $panel_section:literal, $panel_heading:literal;)+ }
        pages { $($(#[$page_doc:meta])* $page:ident, $page_section:literal, $page_heading:literal;)+ }
        questions { $($(#[$doc:meta])* $question:ident, $section:literal, $heading:literal;)+ }
    ) => {
        contexts! {
            $($(#[$panel_doc])* $panel, $panel_section, $panel_heading;)+
            $($(#[$page_doc])* $page, $page_section, $page_heading;)+
            $($(#[$doc])* $question, $section, $heading;)+
        }

        impl Context {
            /// The pages.
            pub const PAGES: &[Self] = &[$(Self::$page),+];
        }
    };
    ($($(#[$doc:meta])* $context:ident, $section:literal, $heading:literal;)+) => {
        /// A context with its own key bindings.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Context {
            /// One of the modes.
            In(Mode),
            /// The first reading of a scene, which has no keys of its own.
            Opening,
            $($(#[$doc])* $context,)+
        }

        impl Context {
            /// All contexts with keys of their own, in the order of the help.
            pub(super) fn all() -> impl Iterator<Item = Self> {
                let modes = Mode::ALL.into_iter().map(Self::In);
                modes.chain([$(Self::$context),+])
            }

            /// The name of its section of keys; `None` if it has no keys of its own.
            pub(super) const fn section(self) -> Option<&'static str> {
                match self {
                    Self::In(mode) => Some(mode.section()),
                    Self::Opening => None,
                    $(Self::$context => Some($section),)+
                }
            }

            /// Its heading in the help.
            pub(super) const fn heading(self) -> &'static str {
                match self {
                    Self::In(mode) => mode.name(),
                    Self::Opening => "",
                    $(Self::$context => $heading,)+
                }
            }
        }
    };
}

contexts! {
    {
        /// The colour picker.
        Colour, "colour", "the colour picker";
        /// The rays behind the pixel under the cross.
        Rays, "rays", "the rays behind a pixel";
        /// The drawing of a region in the full-size trace.
        Region, "region", "while a region is drawn";
        /// The list of errors.
        Errors, "errors", "the list of errors";
    }
    pages {
        /// The page of saved views.
        Views, "views", "the list of saved views";
        /// The page of recently used scenes.
        Recent, "recent", "the list of recent scenes";
        /// The page of the undo history.
        History, "history", "the undo history";
        /// The page of the sample scenes.
        Samples, "samples", "the sample scenes";
        /// The page of the messages so far.
        Messages, "messages", "the messages so far";
        /// The help page.
        Help, "help", "this page";
    }
    questions {
        /// The question how to resolve a merge.
        Conflict, "conflict", "merge conflicts";
        /// The question whether to quit although edits are unsaved.
        Quit, "quit", "when asked to confirm quitting";
        /// The question whether to delete what others use.
        Delete, "delete", "when asked to confirm deleting";
        /// The question whether to leave the scene for another one.
        Leave, "leave", "when asked to confirm leaving the scene";
        /// The question whether to leave although the saved text lacks the moved view.
        MovedView, "moved-view", "when asked to leave a moved view";
        /// The question whether to quit although a file is being saved or exported.
        Wait, "wait", "when asked to quit during a save or an export";
        /// The question whether to save unsaved edits and open the editor.
        SaveFirst, "save-first", "when the editor is opened on unsaved edits";
        /// The question whether an export may overwrite a file.
        Overwrite, "overwrite", "when asked to overwrite a picture";
        /// The question whether to recover the edits of an earlier run.
        Recover, "recover", "when unsaved edits were found";
    }
}
