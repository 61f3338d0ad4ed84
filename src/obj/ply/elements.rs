//! What the elements of a `.ply` file are, and how they are written.

/// How the values behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// What each row of an element consists of, in this order.
#[derive(Clone, Copy, Debug)]
pub(super) enum Column {
    /// A value with what it is for: [`X`] and so on; `None` if it is not used.
    One(Scalar, Option<usize>),
    /// The number of items, and so many.
    List {
        count: Scalar,
        item: Scalar,
        /// Whether the items are the vertices of a face.
        is_face: bool,
    },
}

/// What a value of a vertex is for. Coordinates are followed by those of the normal and of the texture.
pub(super) const X: usize = 0;
pub(super) const NORMAL: usize = 3;
pub(super) const UV: usize = 6;
/// The number of these.
pub(super) const USES: usize = 8;

/// The names of what is used of a vertex.
pub(super) const NAMES: [&[&str]; USES] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["s", "u", "texture_u", "texture_s"],
    &["t", "v", "texture_v", "texture_t"],
];

/// What is called so in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Face,
    /// It is skipped.
    Other,
}

impl Kind {
    /// The word for a row of it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Vertex => "vertex",
            Self::Face => "face",
            Self::Other => "element",
        }
    }
}

/// A kind of rows.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) kind: Kind,
    /// How many rows the file claims to have.
    pub(super) count: u64,
    pub(super) columns: Vec<Column>,
}

impl Element {
    /// Whether its rows have all of these values.
    pub(super) fn has(&self, uses: std::ops::Range<usize>) -> bool {
        let has = |wanted| {
            let is =
                |column: &Column| matches!(column, Column::One(_, Some(own)) if *own == wanted);
            self.columns.iter().any(is)
        };
        uses.into_iter().all(has)
    }

    /// Whether its rows have the vertices of a face.
    pub(super) fn lists_corners(&self) -> bool {
        let lists = |column: &Column| matches!(column, Column::List { is_face: true, .. });
        self.columns.iter().any(lists)
    }

    /// The least bytes of a row.
    pub(super) fn least(&self, encoding: Encoding) -> usize {
        let column = |column: &Column| match (encoding, column) {
            // A digit and a blank.
            (Encoding::Text, _) => 2,
            (_, Column::One(scalar, _)) => scalar.size(),
            (_, Column::List { count, .. }) => count.size(),
        };
        self.columns.iter().map(column).sum()
    }
}

impl Scalar {
    pub(super) fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Its bytes where it is not text.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) const fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}
