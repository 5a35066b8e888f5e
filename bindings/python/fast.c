/* SPDX-License-Identifier: BSD-3-Clause */
/* The module cairn._fast: Filter.update without cffi. cffi and numpy's conversions take longer than a small update
 * itself. The module is optional: whatever it does not take goes the way of cffi (cairn/_frames.py), with the same
 * result.
 *
 * It uses Python's limited interface, so one compiled module serves all versions of Python from 3.11 on. */
#define Py_LIMITED_API 0x030b0000
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <cairn/filter.h>
#include <string.h>

typedef cairn_status (*update_fn)(cairn_filter *filter, int32_t sensor, const cairn_observation *observations,
                                  size_t count, cairn_match *matches, cairn_error *error);

/* Frames up to this length need no memory from the heap. */
enum { ON_STACK = 64 };

/* Answers of the functions below: done; not for this module; a Python exception is set. */
typedef enum { DONE, OTHER_WAY, RAISED } answer;

static answer other_way(void) {
  PyErr_Clear();
  return OTHER_WAY;
}

/* The letter of a buffer's format in this machine's byte order, or 0. */
static char letter(const Py_buffer *view) {
  const char *format = view->format == NULL ? "B" : view->format;
  if (*format == '@' || *format == '=') ++format;
  return format[0] != 0 && format[1] == 0 ? format[0] : 0;
}

/* Ids from an array of whole numbers of 64 bits, or from a list of whole numbers. */
static answer read_ids(PyObject *ids, cairn_observation *frame, Py_ssize_t count) {
  if (PyList_CheckExact(ids)) {
    for (Py_ssize_t i = 0; i < count; ++i) {
      PyObject *id = PyList_GetItem(ids, i);
      if (id == NULL || !PyLong_CheckExact(id)) return other_way();
      frame[i].id = PyLong_AsUnsignedLongLong(id);
      if (frame[i].id == UINT64_MAX && PyErr_Occurred()) return other_way();
    }
    return DONE;
  }
  Py_buffer view;
  if (PyObject_GetBuffer(ids, &view, PyBUF_STRIDES | PyBUF_FORMAT) != 0) return other_way();
  const char kind = letter(&view);
  const int is_signed = kind == 'l' || kind == 'q';
  answer result = OTHER_WAY;
  if (view.ndim == 1 && view.itemsize == 8 && view.shape[0] == count && (is_signed || kind == 'L' || kind == 'Q')) {
    result = DONE;
    for (Py_ssize_t i = 0; i < count && result == DONE; ++i) {
      memcpy(&frame[i].id, (const char *)view.buf + i * view.strides[0], 8);
      if (is_signed && frame[i].id > INT64_MAX) result = OTHER_WAY; /* negative */
    }
  }
  PyBuffer_Release(&view);
  return result;
}

static answer read_row(PyObject *row, double *z, Py_ssize_t rows) {
  const int is_list = PyList_CheckExact(row);
  if (!is_list && !PyTuple_CheckExact(row)) return OTHER_WAY;
  if ((is_list ? PyList_Size(row) : PyTuple_Size(row)) != rows) return OTHER_WAY;
  for (Py_ssize_t k = 0; k < rows; ++k) {
    PyObject *value = is_list ? PyList_GetItem(row, k) : PyTuple_GetItem(row, k);
    if (value == NULL || !(PyFloat_Check(value) || PyLong_CheckExact(value))) return other_way();
    z[k] = PyFloat_AsDouble(value);
    if (z[k] == -1.0 && PyErr_Occurred()) return other_way();
  }
  return DONE;
}

/* Values from an array of doubles (n x rows, any strides), or from a list of lists or tuples. */
static answer read_z(PyObject *z, cairn_observation *frame, Py_ssize_t count) {
  if (PyList_CheckExact(z)) {
    if (PyList_Size(z) != count) return OTHER_WAY;
    Py_ssize_t rows = -1;
    for (Py_ssize_t i = 0; i < count; ++i) {
      PyObject *row = PyList_GetItem(z, i);
      if (rows < 0) rows = PyObject_Length(row);
      if (rows < 1 || rows > 3) return other_way();
      const answer result = read_row(row, frame[i].z, rows);
      if (result != DONE) return result;
    }
    return DONE;
  }
  Py_buffer view;
  if (PyObject_GetBuffer(z, &view, PyBUF_STRIDES | PyBUF_FORMAT) != 0) return other_way();
  answer result = OTHER_WAY;
  if (view.ndim == 2 && letter(&view) == 'd' && view.shape[0] == count && view.shape[1] >= 1 && view.shape[1] <= 3) {
    result = DONE;
    for (Py_ssize_t i = 0; i < count; ++i)
      for (Py_ssize_t k = 0; k < view.shape[1]; ++k)
        memcpy(&frame[i].z[k], (const char *)view.buf + i * view.strides[0] + k * view.strides[1], sizeof(double));
  }
  PyBuffer_Release(&view);
  return result;
}

static PyObject *call(PyObject *const *arguments, int32_t sensor, const cairn_observation *frame, size_t count,
                      PyObject *matches) {
  update_fn update;
  *(void **)&update = PyLong_AsVoidPtr(arguments[0]); /* C has no cast from an object to a function */
  cairn_filter *filter = PyLong_AsVoidPtr(arguments[1]);
  cairn_error *error = PyLong_AsVoidPtr(arguments[2]);
  if (PyErr_Occurred()) return NULL;
  Py_buffer view;
  if (PyObject_GetBuffer(matches, &view, PyBUF_WRITABLE) != 0) return NULL;
  if ((size_t)view.len != count * sizeof(cairn_match)) {
    PyBuffer_Release(&view);
    PyErr_SetString(PyExc_ValueError, "matches: it has another length than the frame");
    return NULL;
  }
  cairn_status status;
  Py_BEGIN_ALLOW_THREADS
  status = update(filter, sensor, frame, count, view.buf, error);
  Py_END_ALLOW_THREADS
  PyBuffer_Release(&view);
  return PyLong_FromLong(status);
}

static PyObject *update_by_ids(PyObject *const *arguments, int32_t sensor, PyObject *matches) {
  PyObject *ids = arguments[4], *z = arguments[5];
  const Py_ssize_t count = PyObject_Length(ids);
  if (count < 0) return NULL;
  cairn_observation on_stack[ON_STACK];
  cairn_observation *frame = on_stack;
  if (count > ON_STACK && (frame = PyMem_Malloc((size_t)count * sizeof *frame)) == NULL) return PyErr_NoMemory();
  memset(frame, 0, (size_t)count * sizeof *frame);
  answer read = read_ids(ids, frame, count);
  if (read == DONE) read = read_z(z, frame, count);
  PyObject *result = NULL;
  if (read == DONE) {
    result = call(arguments, sensor, frame, (size_t)count, matches);
  } else if (read == OTHER_WAY) {
    result = Py_NewRef(Py_None);
  }
  if (frame != on_stack) PyMem_Free(frame);
  return result;
}

PyDoc_STRVAR(update_doc,
             "update(function, filter, error, sensor, ids, z, matches)\n--\n\n"
             "Calls cairn_filter_update; function, filter and error are addresses. `ids` is a complete array of\n"
             "observations if z is None. Returns the status, or None if the arguments have to go another way.");

static PyObject *update(PyObject *Py_UNUSED(module), PyObject *const *arguments, Py_ssize_t count) {
  if (count != 7) {
    PyErr_SetString(PyExc_TypeError, "update takes 7 arguments");
    return NULL;
  }
  const long sensor = PyLong_AsLong(arguments[3]);
  if (sensor == -1 && PyErr_Occurred()) {
    if (!PyErr_ExceptionMatches(PyExc_OverflowError)) return NULL;
    PyErr_Clear();
    return Py_NewRef(Py_None);
  }
  if (sensor < INT32_MIN || sensor > INT32_MAX) return Py_NewRef(Py_None);
  if (arguments[5] != Py_None) return update_by_ids(arguments, (int32_t)sensor, arguments[6]);
  Py_buffer view;
  if (PyObject_GetBuffer(arguments[4], &view, PyBUF_C_CONTIGUOUS) != 0) {
    PyErr_Clear();
    return Py_NewRef(Py_None);
  }
  const size_t length = (size_t)view.len / sizeof(cairn_observation);
  PyObject *result = call(arguments, (int32_t)sensor, view.buf, length, arguments[6]);
  PyBuffer_Release(&view);
  return result;
}

static PyMethodDef methods[] = {{"update", (PyCFunction)(void (*)(void))update, METH_FASTCALL, update_doc},
                                {NULL, NULL, 0, NULL}};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, "cairn._fast", "Filter.update without cffi.", 0, methods,
                                    NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit__fast(void) { return PyModule_Create(&module); }
