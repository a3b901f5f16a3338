//! The table of a study as Parquet.

use std::sync::Arc;

use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use ::parquet::schema::types::{Type, TypePtr};
use serde_json::Value as Cell;

use super::table::{Column, Kind, StudyTable};

/// The table as a Parquet file: one group of rows, columns that may be null.
///
/// # Errors
///
/// If the library refuses it.
pub fn bytes(table: &StudyTable) -> Result<Vec<u8>, ParquetError> {
    let fields = table.columns().iter().map(field);
    let fields = fields.collect::<Result<_, ParquetError>>()?;
    let schema = Type::group_type_builder("runs")
        .with_fields(fields)
        .build()?;
    let properties = WriterProperties::builder().build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in table.columns() {
        write(&mut group, column)?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(column: &Column) -> Result<TypePtr, ParquetError> {
    let (physical, logical) = match column.kind {
        Kind::Integer => (Physical::INT64, None),
        Kind::Number => (Physical::DOUBLE, None),
        Kind::Truth => (Physical::BOOLEAN, None),
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical)
        .with_logical_type(logical)
        .with_repetition(Repetition::OPTIONAL);
    Ok(Arc::new(field.build()?))
}

fn write(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    column: &Column,
) -> Result<(), ParquetError> {
    let cells = &column.cells;
    match column.kind {
        Kind::Integer => write_as::<Int64Type>(group, cells, Cell::as_i64),
        Kind::Number => write_as::<DoubleType>(group, cells, Cell::as_f64),
        Kind::Truth => write_as::<BoolType>(group, cells, Cell::as_bool),
        Kind::Text => {
            write_as::<ByteArrayType>(group, cells, |it| it.as_str().map(ByteArray::from))
        }
    }
}

/// Writes the cells that have a value, and for all whether they do.
fn write_as<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    cells: &[Cell],
    value: impl Fn(&Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let values: Vec<Option<T::T>> = cells.iter().map(value).collect();
    let present: Vec<i16> = values.iter().map(|it| i16::from(it.is_some())).collect();
    let values: Vec<T::T> = values.into_iter().flatten().collect();
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("more columns than fields".to_owned()));
    };
    column
        .typed::<T>()
        .write_batch(&values, Some(&present), None)?;
    column.close()
}
