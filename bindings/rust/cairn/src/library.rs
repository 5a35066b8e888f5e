// SPDX-License-Identifier: BSD-3-Clause
//! The loaded library: its version, what it can do, and whether this crate can use it.
use crate::{Doubts, Error, Result, Status, Verdict, VERSION};
use cairn_sys as sys;
use std::ffi::{CStr, CString};
use std::os::raw::c_char;
use std::sync::atomic::{AtomicU32, Ordering};

/// A text that the library owns and never changes.
fn text(pointer: *const c_char) -> &'static str {
    // SAFETY: the library returns constant, zero-terminated texts.
    unsafe { CStr::from_ptr(pointer) }.to_str().unwrap_or("")
}

//~ cairn_version
/// Version of the loaded library, for example "0.2.0".
///
/// Complexity: O(1).
pub fn version() -> &'static str {
    // SAFETY: no arguments.
    text(unsafe { sys::cairn_version() })
}

//~ cairn_version_number
/// Version of the loaded library as a number, as `CAIRN_VERSION` is that of the header: 10000 major + 100 minor +
/// patch.
///
/// Complexity: O(1).
pub fn version_number() -> u32 {
    // SAFETY: no arguments.
    unsafe { sys::cairn_version_number() }
}

//~ cairn_build
/// Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").
///
/// Complexity: O(1).
pub fn build() -> &'static str {
    // SAFETY: no arguments.
    text(unsafe { sys::cairn_build() })
}

//~ cairn_has
/// Whether the loaded library has a feature: 1 or 0. Features have names that never change their meaning: "sparse"
/// (sparse joining), "teams", "trajectory", "systematic" (estimated systematic errors), "robust" (robust losses),
/// "health" (verdicts), "errors" (messages in a [`Error`](crate::Error)).
///
/// Complexity: O(1).
pub fn has(feature: &str) -> bool {
    let feature = CString::new(feature).unwrap_or_default();
    // SAFETY: a zero-terminated text.
    unsafe { sys::cairn_has(feature.as_ptr()) != 0 }
}

//~ cairn_id_none
/// [`ID_NONE`](crate::ID_NONE), for languages that cannot read a macro.
///
/// Complexity: O(1).
pub fn id_none() -> u64 {
    // SAFETY: no arguments.
    unsafe { sys::cairn_id_none() }
}

//~ cairn_last_message
/// The message of the last call of this thread that failed, for programs in C: the line that [`Error`](crate::Error)
/// would have got, in UTF-8. It is empty before the first failure and stays until the next failure. The library owns
/// the buffer; each thread has its own. A language whose runtime moves calls between threads passes a
/// [`Error`](crate::Error) instead.
///
/// Complexity: O(1).
pub fn last_message() -> String {
    // SAFETY: a zero-terminated text of this thread, copied at once.
    unsafe { CStr::from_ptr(sys::cairn_last_message()) }.to_string_lossy().into_owned()
}

//~ cairn_sim_last_message
/// One line about the last call of this library that failed in this thread, like [`last_message`](crate::last_message)
/// for libcairn.
///
/// Complexity: O(1).
#[cfg(feature = "sim")]
pub fn sim_last_message() -> String {
    // SAFETY: a zero-terminated text of this thread, copied at once.
    unsafe { CStr::from_ptr(sys::cairn_sim_last_message()) }.to_string_lossy().into_owned()
}

impl Status {
    //~ cairn_status_name
    /// Name of a status, for example "[`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)"; "unknown status" for
    /// any other value.
    ///
    /// Complexity: O(1).
    pub fn name(self) -> &'static str {
        // SAFETY: any value is allowed.
        text(unsafe { sys::cairn_status_name(self.0) })
    }
}

impl Verdict {
    //~ cairn_verdict_text
    /// A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value.
    ///
    /// Complexity: O(1).
    pub fn text(self) -> &'static str {
        // SAFETY: any value is allowed.
        text(unsafe { sys::cairn_verdict_text(self.0) })
    }
}

impl Doubts {
    //~ cairn_doubt_text
    /// A reason in words, for example "single landmarks contradict the rest". `reason` is one bit; anything else gives
    /// "unknown".
    ///
    /// Complexity: O(1).
    pub fn text(self) -> &'static str {
        // SAFETY: any value is allowed.
        text(unsafe { sys::cairn_doubt_text(self.0) })
    }

    /// The single reasons, lowest bit first.
    pub fn reasons(self) -> impl Iterator<Item = Doubts> {
        (0..u32::BITS).map(|bit| 1 << bit).filter(move |bit| self.0 & bit != 0).map(Doubts)
    }
}

/// Refuses a library of another major or minor version: before 1.0 their interfaces differ.
pub(crate) fn suitable() -> Result<()> {
    static LOADED: AtomicU32 = AtomicU32::new(0); // 0: not asked yet
    let mut loaded = LOADED.load(Ordering::Relaxed);
    if loaded == 0 {
        loaded = version_number();
        LOADED.store(loaded, Ordering::Relaxed);
    }
    if loaded / 100 == VERSION / 100 {
        return Ok(());
    }
    let name = |number: u32| format!("{}.{}.{}", number / 10_000, number / 100 % 100, number % 100);
    Err(Error::new(
        Status::ERROR_STATE,
        format!(
            "the crate cairn {} needs libcairn {}.{}, but libcairn {} is loaded; install the library of that version",
            env!("CARGO_PKG_VERSION"),
            VERSION / 10_000,
            VERSION / 100 % 100,
            name(loaded)
        ),
    ))
}
