//! Fields, and their arrays in a VTU file: values in blocks compressed by zlib, as base64.
//!
//! Blocks are compressed as a whole and by all threads. The writer of vtkio compresses number by number, which takes ten times as long.

use std::io::{self, Write};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use base64::write::EncoderWriter;
use ligament_model::parallel;
use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::xml::escape_attribute;

/// Size of a block before compression, VTK's default, bytes.
const BLOCK_SIZE: usize = 32_768;

/// Compression level of zlib: at 100,000 points level 6 takes 9 times the time of level 1 and saves 1 % of the size.
const COMPRESSION_LEVEL: u8 = 1;

/// A named field: the same number of values for each point or cell.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// Name in readers, unique among the point fields and among the cell fields.
    pub(super) name: &'a str,
    numbers: Numbers<'a>,
    /// Order of the points or cells in the file; none where it is the present one.
    order: Option<&'a [u32]>,
    /// Number of values per point or cell.
    n_components: usize,
    /// Names of the components: all of them or none.
    component_names: &'a [&'a str],
}

/// Values of a field at selected points or cells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SelectedValues {
    Double(Vec<f64>),
    Single(Vec<f32>),
    Integer(Vec<i64>),
    Byte(Vec<u8>),
}

#[derive(Debug, Clone, Copy)]
enum Numbers<'a> {
    Double(Values<'a, f64>),
    Single(Values<'a, f32>),
    Integer(Values<'a, i64>),
    Byte(Values<'a, u8>),
}

/// Values in an array, or computed where they are written, so that the array is never in memory.
#[derive(Clone, Copy)]
enum Values<'a, T> {
    Listed(&'a [T]),
    Computed(usize, &'a (dyn Fn(usize) -> T + Sync)),
}

impl<T> std::fmt::Debug for Values<'_, T> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} values", self.len())
    }
}

impl<T> Values<'_, T> {
    fn len(&self) -> usize {
        match self {
            Self::Listed(values) => values.len(),
            Self::Computed(count, _) => *count,
        }
    }
}

impl<T: Copy> Values<'_, T> {
    #[inline]
    fn at(&self, place: usize) -> T {
        match self {
            Self::Listed(values) => values[place],
            Self::Computed(_, value) => value(place),
        }
    }
}

impl<'a> Field<'a> {
    /// A field of numbers.
    pub fn scalar(name: &'a str, values: &'a [f64]) -> Self {
        Self::new(name, Numbers::Double(Values::Listed(values)), 1, &[])
    }

    /// A field of numbers in single precision (seven digits).
    pub fn single(name: &'a str, values: &'a [f32]) -> Self {
        Self::new(name, Numbers::Single(Values::Listed(values)), 1, &[])
    }

    /// A field of vectors; in the plane with a third component of 0, which VTK requires.
    pub fn vector(name: &'a str, values: &'a [[f64; 3]]) -> Self {
        Self::new(
            name,
            Numbers::Double(Values::Listed(values.as_flattened())),
            3,
            &[],
        )
    }

    /// A field of integers, such as numbers of bonds or flags.
    pub fn integer(name: &'a str, values: &'a [i64]) -> Self {
        Self::new(name, Numbers::Integer(Values::Listed(values)), 1, &[])
    }

    /// A field of `count` numbers that a function gives by their indices.
    pub fn computed(name: &'a str, count: usize, value: &'a (dyn Fn(usize) -> f64 + Sync)) -> Self {
        Self::new(
            name,
            Numbers::Double(Values::Computed(count, value)),
            1,
            &[],
        )
    }

    /// A field of `count` numbers in single precision that a function gives by their indices.
    pub fn computed_single(
        name: &'a str,
        count: usize,
        value: &'a (dyn Fn(usize) -> f32 + Sync),
    ) -> Self {
        Self::new(
            name,
            Numbers::Single(Values::Computed(count, value)),
            1,
            &[],
        )
    }

    /// A field of `count` integers that a function gives by their indices.
    pub fn computed_integer(
        name: &'a str,
        count: usize,
        value: &'a (dyn Fn(usize) -> i64 + Sync),
    ) -> Self {
        Self::new(
            name,
            Numbers::Integer(Values::Computed(count, value)),
            1,
            &[],
        )
    }

    /// A field with named components, such as a stress, shape (n, number of names).
    pub fn components(name: &'a str, names: &'a [&'a str], values: &'a [f64]) -> Self {
        Self::new(
            name,
            Numbers::Double(Values::Listed(values)),
            names.len(),
            names,
        )
    }

    /// A field with `n_components` components, with or without names, shape (n, n_components).
    pub fn numbers(
        name: &'a str,
        n_components: usize,
        component_names: &'a [&'a str],
        values: &'a [f64],
    ) -> Self {
        Self::new(
            name,
            Numbers::Double(Values::Listed(values)),
            n_components,
            component_names,
        )
    }

    /// Whether the field has this name.
    pub(crate) fn is(&self, name: &str) -> bool {
        self.name == name
    }

    /// The field with its points or cells written in an order, if given.
    pub fn ordered(self, order: Option<&'a [u32]>) -> Self {
        Self { order, ..self }
    }

    /// A field of bytes, such as types of cells.
    pub(super) fn bytes(name: &'a str, values: &'a [u8]) -> Self {
        Self::new(name, Numbers::Byte(Values::Listed(values)), 1, &[])
    }

    fn new(
        name: &'a str,
        numbers: Numbers<'a>,
        n_components: usize,
        component_names: &'a [&'a str],
    ) -> Self {
        Self {
            name,
            numbers,
            order: None,
            n_components,
            component_names,
        }
    }

    /// Values of some points or cells, given by their indices in the file.
    pub(crate) fn at(&self, rows: &[u32]) -> SelectedValues {
        let taken: Vec<u32>;
        let rows = match self.order {
            None => rows,
            Some(order) => {
                taken = rows.iter().map(|&row| order[row as usize]).collect();
                &taken
            }
        };
        fn chosen<T: Copy>(values: &Values<'_, T>, n_components: usize, rows: &[u32]) -> Vec<T> {
            let places = rows.iter().flat_map(|&row| {
                let first = n_components * row as usize;
                first..first + n_components
            });
            places.map(|place| values.at(place)).collect()
        }
        let n = self.n_components;
        match &self.numbers {
            Numbers::Double(values) => SelectedValues::Double(chosen(values, n, rows)),
            Numbers::Single(values) => SelectedValues::Single(chosen(values, n, rows)),
            Numbers::Integer(values) => SelectedValues::Integer(chosen(values, n, rows)),
            Numbers::Byte(values) => SelectedValues::Byte(chosen(values, n, rows)),
        }
    }

    /// The field with other values.
    pub(crate) fn with<'b>(&self, chosen: &'b SelectedValues) -> Field<'b>
    where
        'a: 'b,
    {
        let numbers = match chosen {
            SelectedValues::Double(values) => Numbers::Double(Values::Listed(values)),
            SelectedValues::Single(values) => Numbers::Single(Values::Listed(values)),
            SelectedValues::Integer(values) => Numbers::Integer(Values::Listed(values)),
            SelectedValues::Byte(values) => Numbers::Byte(Values::Listed(values)),
        };
        Field {
            numbers,
            order: None,
            ..*self
        }
    }

    /// The number of points or cells that have values.
    pub(super) fn len(&self) -> usize {
        let count = match &self.numbers {
            Numbers::Double(values) => values.len(),
            Numbers::Single(values) => values.len(),
            Numbers::Integer(values) => values.len(),
            Numbers::Byte(values) => values.len(),
        };
        count / self.n_components.max(1)
    }

    /// Whether readers treat the field as a scalar; integers are not.
    pub(super) fn is_scalar(&self) -> bool {
        let is_float = matches!(self.numbers, Numbers::Double(_) | Numbers::Single(_));
        is_float && self.n_components == 1 && self.component_names.is_empty()
    }

    /// Whether readers treat the field as a vector.
    pub(super) fn is_vector(&self) -> bool {
        self.n_components == 3 && self.component_names.is_empty()
    }

    /// The element `DataArray`, compressed.
    pub(super) fn array(&self) -> Array {
        match &self.numbers {
            Numbers::Double(values) => self.compressed(values, f64::to_le_bytes),
            Numbers::Single(values) => self.compressed(values, f32::to_le_bytes),
            Numbers::Integer(values) => self.compressed(values, i64::to_le_bytes),
            Numbers::Byte(values) => self.compressed(values, u8::to_le_bytes),
        }
    }

    /// The element `PDataArray`, which describes the arrays of this field in the pieces of a grid.
    pub(super) fn outline(&self) -> String {
        format!("<PDataArray{}/>\n", self.attributes())
    }

    /// XML attributes for type, name and components.
    fn attributes(&self) -> String {
        let vtk_type = match self.numbers {
            Numbers::Double(_) => "Float64",
            Numbers::Single(_) => "Float32",
            Numbers::Integer(_) => "Int64",
            Numbers::Byte(_) => "UInt8",
        };
        let name = escape_attribute(self.name);
        let mut attributes = format!(" type=\"{vtk_type}\" Name=\"{name}\"");
        // meshio adds a second dimension to any array with a number of components, even 1.
        if self.n_components > 1 {
            attributes.push_str(&format!(" NumberOfComponents=\"{}\"", self.n_components));
        }
        // Capitals, as VTK names the components of vectors and tensors itself.
        for (number, name) in self.component_names.iter().enumerate() {
            let name = escape_attribute(&name.to_uppercase());
            attributes.push_str(&format!(" ComponentName{number}=\"{name}\""));
        }
        attributes
    }

    fn compressed<T: Copy + Sync, const SIZE: usize>(
        &self,
        values: &Values<'_, T>,
        to_le_bytes: impl Fn(T) -> [u8; SIZE] + Sync,
    ) -> Array {
        let n = self.n_components;
        let n_values = self.order.map_or(values.len(), |order| n * order.len());
        let place = |place: usize| match self.order {
            None => place,
            Some(order) => n * order[place / n] as usize + place % n,
        };
        let of_block = BLOCK_SIZE / SIZE;
        let blocks = parallel::map((0..n_values).step_by(of_block), |first| {
            let mut bytes = Vec::with_capacity(BLOCK_SIZE);
            for it in first..n_values.min(first + of_block) {
                bytes.extend_from_slice(&to_le_bytes(values.at(place(it))));
            }
            compress_to_vec_zlib(&bytes, COMPRESSION_LEVEL)
        });
        Array {
            attributes: self.attributes(),
            n_bytes: n_values * SIZE,
            blocks,
        }
    }
}

/// The element `DataArray` of a field.
pub(super) struct Array {
    /// XML attributes for type, name and components.
    attributes: String,
    /// Size of the values before compression, bytes.
    n_bytes: usize,
    /// Compressed blocks of the values.
    blocks: Vec<Vec<u8>>,
}

impl Array {
    /// The element with a further attribute.
    pub(super) fn with_attribute(mut self, name: &str, value: usize) -> Self {
        self.attributes
            .insert_str(0, &format!(" {name}=\"{value}\""));
        self
    }

    /// Appends the element to a document.
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        write!(out, "<DataArray{} format=\"binary\">", self.attributes)?;
        let header = header(&self.blocks, self.n_bytes);
        out.write_all(BASE64_STANDARD.encode(header).as_bytes())?;
        let mut encoder = EncoderWriter::new(&mut *out, &BASE64_STANDARD);
        for block in &self.blocks {
            encoder.write_all(block)?;
        }
        encoder.finish()?;
        drop(encoder);
        out.write_all(b"</DataArray>\n")
    }
}

/// Header of compressed blocks: the number of blocks, the sizes of the first blocks and of the last one before compression, and the size of
/// each block after it, all `UInt64`.
///
/// For a full last block VTK also accepts a size of zero, but vtkio then loses the block.
fn header(blocks: &[Vec<u8>], n_bytes: usize) -> Vec<u8> {
    let first_blocks = blocks.len().saturating_sub(1) * BLOCK_SIZE;
    let sizes = [blocks.len(), BLOCK_SIZE, n_bytes - first_blocks];
    sizes
        .into_iter()
        .chain(blocks.iter().map(Vec::len))
        .flat_map(|size| (size as u64).to_le_bytes())
        .collect()
}
