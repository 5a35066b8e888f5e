// SPDX-License-Identifier: BSD-3-Clause
//! Arrays that the library fills: the caller's buffer, its capacity, and the number of elements.
use crate::error::{call, Result};
use crate::{Error, Status};
use cairn_sys as sys;
use std::mem::MaybeUninit;

/// Fills a `Vec` by a query, in the memory that the `Vec` has. Only if that is too short, more is taken and the query
/// is made again. `T` has the layout of the library's element.
pub(crate) fn fill<T>(
    buffer: &mut Vec<T>,
    query: impl Fn(*mut T, usize, *mut usize, *mut sys::cairn_error) -> sys::cairn_status,
) -> Result<()> {
    buffer.clear();
    loop {
        let mut needed = 0;
        let capacity = buffer.capacity();
        let result = call(|error| query(buffer.as_mut_ptr(), capacity, &mut needed, error));
        match result {
            Ok(()) if needed <= capacity => {
                // SAFETY: the query has written `needed` elements, which is not more than the capacity.
                unsafe { buffer.set_len(needed) };
                return Ok(());
            }
            Ok(()) => {} // capacity 0 asked for the number
            Err(error) if error.status() == Status::ERROR_BUFFER && needed > capacity => {}
            Err(error) => return Err(error),
        }
        buffer.reserve_exact(needed);
    }
}

/// A new `Vec` from a function that fills one.
pub(crate) fn gather<T>(fill: impl FnOnce(&mut Vec<T>) -> Result<()>) -> Result<Vec<T>> {
    let mut buffer = Vec::new();
    fill(&mut buffer)?;
    Ok(buffer)
}

/// The value that a call writes.
#[inline]
pub(crate) fn get<T>(query: impl FnOnce(*mut T, *mut sys::cairn_error) -> sys::cairn_status) -> Result<T> {
    let mut value = MaybeUninit::uninit();
    call(|error| query(value.as_mut_ptr(), error))?;
    // SAFETY: a call that succeeds has written its output.
    Ok(unsafe { value.assume_init() })
}

/// Refuses a slice of another length than the one that the library will read or write.
pub(crate) fn expect_length(name: &str, length: usize, expected: usize) -> Result<()> {
    if length == expected {
        return Ok(());
    }
    Err(Error::new(Status::ERROR_ARGUMENT, format!("{name} must hold {expected} values, and holds {length}")))
}

/// The pointer of something that may be missing.
#[inline]
pub(crate) fn pointer<T, U>(value: Option<&T>) -> *const U {
    value.map_or(std::ptr::null(), |value| (value as *const T).cast())
}

/// The first element of a slice, or null: for the library an empty array is one that is missing.
#[inline]
pub(crate) fn first<T>(values: &[T]) -> *const T {
    if values.is_empty() {
        std::ptr::null()
    } else {
        values.as_ptr()
    }
}
