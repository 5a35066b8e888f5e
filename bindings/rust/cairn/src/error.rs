// SPDX-License-Identifier: BSD-3-Clause
//! Errors of calls, and the way in which every call gets its own message.
use crate::callback;
use crate::Status;
use cairn_sys as sys;
use std::borrow::Cow;
use std::ffi::CStr;
use std::fmt;
use std::mem::{size_of, MaybeUninit};
use std::ptr::{addr_of, addr_of_mut};

/// An error of the caller's own, as a callback returns it.
pub type Source = Box<dyn std::error::Error + Send + Sync + 'static>;

/// Result of a call of the library.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call failed. The call changed nothing. [`std::error::Error::source`] is the error that a callback returned, if
/// a callback aborted the call.
#[derive(Debug)]
pub struct Error {
    status: Status,
    message: Cow<'static, str>,
    source: Option<Source>,
}

impl Error {
    pub(crate) fn new(status: Status, message: impl Into<Cow<'static, str>>) -> Self {
        Error { status, message: message.into(), source: None }
    }

    /// The status that the library returned.
    pub fn status(&self) -> Status {
        self.status
    }

    /// One line: the argument or variable, the cause, the remedy.
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.as_ref().map(|source| &**source as _)
    }
}

/// Calls the library with room for its error. A panic of a callback continues here.
#[inline]
pub(crate) fn call(function: impl FnOnce(*mut sys::cairn_error) -> sys::cairn_status) -> Result<()> {
    // A call that succeeds does not touch the error, so only what a failed call is certain to need is written.
    let mut error = MaybeUninit::<sys::cairn_error>::uninit();
    let place = error.as_mut_ptr();
    // SAFETY: both values lie inside `error`.
    unsafe {
        addr_of_mut!((*place).struct_size).write(size_of::<sys::cairn_error>() as u32);
        addr_of_mut!((*place).message).cast::<u8>().write(0);
    }
    match function(place) {
        sys::CAIRN_OK => Ok(()),
        status => Err(failed(status, place)),
    }
}

#[cold]
fn failed(status: sys::cairn_status, error: *const sys::cairn_error) -> Error {
    // SAFETY: the message is zero-terminated: by the library, or because `call` wrote a zero.
    let message = unsafe { CStr::from_ptr(addr_of!((*error).message).cast()) }.to_string_lossy().into_owned();
    Error { status: Status(status), message: message.into(), source: callback::take_failure() }
}
