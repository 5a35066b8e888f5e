// SPDX-License-Identifier: BSD-3-Clause
//! The handle of a filter: creation, log, end.
use crate::arrays::get;
use crate::callback;
use crate::error::{call, Result};
use crate::library::suitable;
use crate::FilterOptions;
use cairn_sys as sys;
use std::fmt;
use std::os::raw::c_void;
use std::ptr::{null_mut, NonNull};

/// Estimates the pose of one vehicle and its map together.
///
/// Changes take `&mut self`: two threads cannot change one filter at the same time.
///
/// ```compile_fail,E0499
/// let mut filter = cairn::Filter::new(&Default::default()).unwrap();
/// std::thread::scope(|scope| {
///     scope.spawn(|| filter.predict_wheels(0.1, 1.0, 1.0));
///     scope.spawn(|| filter.predict_wheels(0.1, 1.0, 1.0));
/// });
/// ```
///
/// A closed filter cannot be used, and its map ends with it:
///
/// ```compile_fail,E0382
/// let filter = cairn::Filter::new(&Default::default()).unwrap();
/// filter.close();
/// filter.pose();
/// ```
///
/// ```compile_fail,E0505
/// let filter = cairn::Filter::new(&Default::default()).unwrap();
/// let map = filter.map();
/// drop(filter);
/// map.size();
/// ```
pub struct Filter {
    handle: NonNull<sys::cairn_filter>,
    logs: bool,
}

// SAFETY: a handle belongs to no thread. What callbacks own is Send.
unsafe impl Send for Filter {}
// SAFETY: const queries of a handle may run side by side. They run no callback; everything else takes &mut self.
unsafe impl Sync for Filter {}

impl FilterOptions {
    //~ cairn_filter_required_bytes
    /// Bytes that [`Filter::new`](crate::Filter::new) will take with these options. Only closings of submaps take more:
    /// workspace while they run, and with sparse joining the memory by which the map grows.
    ///
    /// Complexity: O(1).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn required_bytes(&self) -> Result<usize> {
        // SAFETY: the library reads the options.
        get(|bytes, error| unsafe { sys::cairn_filter_required_bytes(&self.c_value(), bytes, error) })
    }
}

impl Filter {
    //~ cairn_filter_create
    /// Creates a filter.
    ///
    /// Complexity: O(memory).
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    /// - [`Status::ERROR_MEMORY`](crate::Status::ERROR_MEMORY)
    pub fn new(options: &FilterOptions) -> Result<Filter> {
        suitable()?;
        let mut handle = null_mut();
        // SAFETY: the library copies the options.
        call(|error| unsafe { sys::cairn_filter_create(&options.c_value(), &mut handle, error) })?;
        // SAFETY: a call that succeeds has written a handle.
        Ok(Filter { handle: unsafe { NonNull::new_unchecked(handle) }, logs: false })
    }

    /// Destroys the filter, as the end of its life does.
    pub fn close(self) {}

    //~ cairn_filter_set_log
    /// Sets the receiver of this filter's log lines (refused batches, numerical refusals). The callback runs inside
    /// calls of the filter and must not call the same filter.
    ///
    /// Complexity: O(1).
    ///
    //~
    /// In Rust the receiver is a closure. A panic in it continues when the call that wrote the line has returned.
    //~ errors
    ///
    /// # Errors
    ///
    /// - [`Status::ERROR_ARGUMENT`](crate::Status::ERROR_ARGUMENT)
    pub fn set_log<F: FnMut(&str) + Send + 'static>(&mut self, log: F) -> Result<()> {
        let payload: *mut c_void = Box::into_raw(Box::new(log)).cast();
        self.logs = true;
        // SAFETY: the functions belong to the type of the closure, which lives until the library releases it.
        let result = self.change(|filter, error| unsafe {
            let release = Some(callback::release::<F> as _);
            sys::cairn_filter_set_log(filter, Some(callback::log::<F>), payload, release, error)
        });
        if result.is_err() {
            // SAFETY: a call that fails leaves the closure to its caller.
            drop(unsafe { Box::from_raw(payload.cast::<F>()) });
        }
        result
    }

    /// Takes the log away that [`Filter::set_log`] set.
    ///
    /// # Errors
    ///
    /// As [`Filter::set_log`].
    pub fn clear_log(&mut self) -> Result<()> {
        // SAFETY: no log needs no payload.
        self.change(|filter, error| unsafe { sys::cairn_filter_set_log(filter, None, null_mut(), None, error) })
    }

    /// Makes a call that changes the filter.
    #[inline]
    pub(crate) fn change(
        &mut self,
        change: impl FnOnce(*mut sys::cairn_filter, *mut sys::cairn_error) -> sys::cairn_status,
    ) -> Result<()> {
        let result = call(|error| change(self.handle.as_ptr(), error));
        if self.logs {
            callback::resume();
        }
        result
    }

    /// The handle for queries.
    #[inline]
    pub(crate) fn c(&self) -> *const sys::cairn_filter {
        self.handle.as_ptr()
    }
}

impl Drop for Filter {
    //~ cairn_filter_destroy
    fn drop(&mut self) {
        // SAFETY: the handle is used for the last time.
        unsafe { sys::cairn_filter_destroy(self.handle.as_ptr()) }
        callback::resume();
    }
}

impl fmt::Debug for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Filter").finish_non_exhaustive()
    }
}
