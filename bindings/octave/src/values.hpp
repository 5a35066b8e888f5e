// SPDX-License-Identifier: BSD-3-Clause
// Values of Octave and MATLAB to values of C and back. Matrices of C are row-major, those of Octave column-major.
// A list of structs in C is one struct in Octave, whose fields have a column (of covariances: a page) for each element.
#pragma once

#include <cairn/cairn.h>
#include <cairn/fleet.h>
#include <cairn/sim.h>
#include <mex.h>

#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace cairn_octave {

// What becomes an error of Octave when the call is over.
struct Failure {
  std::string id;
  std::string text;
};

[[noreturn]] inline void fail(const char* id, const char* format, ...) {
  char text[1024];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  throw Failure{std::string("cairn:") + id, text};
}

struct Constant {
  const char* name;  // without the prefix
  int64_t value;
};

struct Enum {
  const char* prefix;
  const Constant* values;
  size_t count;
};

enum class Kind { number, id, uint32, int32, boolean, constant, bits, object };

struct Struct;

struct Field {
  const char* name;
  Kind kind;
  size_t offset;
  size_t length;          // numbers in C
  size_t rows;            // of the matrix that the numbers are; 0: a vector
  const Enum* constants;  // of a constant
  const Struct* object;   // of a nested struct
};

struct Struct {
  const char* name;
  size_t size;
  const Field* fields;
  size_t count;
};

inline size_t size(const mxArray* value, int dimension) {
  return static_cast<size_t>(mxGetDimensions(value)[dimension]);
}

inline std::string shape_of(const mxArray* value) {
  std::string text;
  for (mwSize i = 0; i < mxGetNumberOfDimensions(value); ++i)
    text += (i ? " x " : "") + std::to_string(mxGetDimensions(value)[i]);
  return text;
}

// Where a value stands, for messages: "update: observations.z".
struct Place {
  std::string call;
  std::string name;
  Place in(const char* field) const { return {call, name + "." + field}; }
  [[noreturn]] void wrong(const std::string& expected, const mxArray* value) const {
    fail("ARGUMENT", "%s: %s must be %s, and is %s %s%s%s", call.c_str(), name.c_str(), expected.c_str(),
         shape_of(value).c_str(), mxIsComplex(value) ? "complex " : "", mxIsSparse(value) ? "sparse " : "",
         mxGetClassName(value));
  }
  [[noreturn]] void wrong(const std::string& expected, double value) const {
    fail("ARGUMENT", "%s: %s must be %s, and is %.17g", call.c_str(), name.c_str(), expected.c_str(), value);
  }
};

inline bool is_real(const mxArray* value) {
  return mxIsNumeric(value) && !mxIsComplex(value) && !mxIsSparse(value);
}

template <typename To, typename From>
To one(From value, const Place& place) {
  if constexpr (std::is_floating_point_v<To> || std::is_same_v<To, From>) {
    return static_cast<To>(value);
  } else {
    // A double holds integers up to 2^53: one above may have been another number before it became a double.
    if constexpr (std::is_floating_point_v<From>) {
      const double most = std::ldexp(1.0, std::numeric_limits<From>::digits);
      if (!(value == std::floor(value))) place.wrong("an integer", static_cast<double>(value));
      if (value > most && sizeof(To) == 8)
        place.wrong("a uint64 if it is beyond 2^53, which a double does not hold", static_cast<double>(value));
      if (value < static_cast<From>(std::numeric_limits<To>::min()) ||
          (sizeof(To) < 8 && value > static_cast<From>(std::numeric_limits<To>::max())))
        place.wrong("an integer of its range", static_cast<double>(value));
    } else {
      const bool negative = value < From{0};
      if ((negative && (std::is_unsigned_v<To> ||
                        static_cast<int64_t>(value) < static_cast<int64_t>(std::numeric_limits<To>::min()))) ||
          (!negative && static_cast<uint64_t>(value) > static_cast<uint64_t>(std::numeric_limits<To>::max())))
        place.wrong("an integer of its range", static_cast<double>(value));
    }
    return static_cast<To>(value);
  }
}

template <typename To, typename From>
void copy_as(const mxArray* value, To* to, size_t first, size_t count, const Place& place) {
  const From* from = static_cast<const From*>(mxGetData(value)) + first;
  if constexpr (std::is_same_v<To, From>) {
    std::memcpy(to, from, count * sizeof(To));
  } else {
    for (size_t i = 0; i < count; ++i) to[i] = one<To>(from[i], place);
  }
}

// Numbers `first` to `first + count` of an array of any numeric class.
template <typename To>
void copy(const mxArray* value, To* to, size_t first, size_t count, const Place& place) {
  if (count == 0) return;
  switch (mxGetClassID(value)) {
    case mxDOUBLE_CLASS:
      return copy_as<To, double>(value, to, first, count, place);
    case mxSINGLE_CLASS:
      return copy_as<To, float>(value, to, first, count, place);
    case mxUINT64_CLASS:
      return copy_as<To, uint64_t>(value, to, first, count, place);
    case mxINT64_CLASS:
      return copy_as<To, int64_t>(value, to, first, count, place);
    case mxUINT32_CLASS:
      return copy_as<To, uint32_t>(value, to, first, count, place);
    case mxINT32_CLASS:
      return copy_as<To, int32_t>(value, to, first, count, place);
    case mxUINT16_CLASS:
      return copy_as<To, uint16_t>(value, to, first, count, place);
    case mxINT16_CLASS:
      return copy_as<To, int16_t>(value, to, first, count, place);
    case mxUINT8_CLASS:
      return copy_as<To, uint8_t>(value, to, first, count, place);
    case mxINT8_CLASS:
      return copy_as<To, int8_t>(value, to, first, count, place);
    default:
      place.wrong("numeric", value);
  }
}

inline bool is_vector(const mxArray* value) {
  return mxGetNumberOfDimensions(value) == 2 &&
         (mxGetM(value) == 1 || mxGetN(value) == 1 || mxGetNumberOfElements(value) == 0);
}

// A matrix, row-major for C; with `rows` 1 or `columns` 1 a vector, which may lie or stand.
inline void read_matrix(const mxArray* value, double* to, size_t rows, size_t columns, const Place& place) {
  const bool vector = rows == 1 || columns == 1;
  if (!is_real(value) || mxGetNumberOfElements(value) != rows * columns ||
      (vector ? !is_vector(value) : mxGetNumberOfDimensions(value) != 2 || mxGetM(value) != rows)) {
    place.wrong(vector ? "a vector of " + std::to_string(rows * columns) + " numbers"
                       : "a matrix of " + std::to_string(rows) + " x " + std::to_string(columns) + " numbers",
                value);
  }
  if (vector) return copy(value, to, 0, rows * columns, place);
  std::vector<double> columns_first(rows * columns);
  copy(value, columns_first.data(), 0, columns_first.size(), place);
  for (size_t row = 0; row < rows; ++row)
    for (size_t column = 0; column < columns; ++column) to[row * columns + column] = columns_first[column * rows + row];
}

template <typename To>
std::vector<To> read_vector(const mxArray* value, const Place& place) {
  if (!is_real(value) || !is_vector(value)) place.wrong("a vector of numbers", value);
  std::vector<To> numbers(mxGetNumberOfElements(value));
  copy(value, numbers.data(), 0, numbers.size(), place);
  return numbers;
}

template <typename To>
To read_scalar(const mxArray* value, const Place& place) {
  if (!is_real(value) || mxGetNumberOfElements(value) != 1)
    place.wrong(std::is_floating_point_v<To> ? "a number" : "an integer", value);
  To number;
  copy(value, &number, 0, 1, place);
  return number;
}

inline cairn_bool read_bool(const mxArray* value, size_t index, const Place& place) {
  if (mxIsLogical(value)) return mxGetLogicals(value)[index];
  double number = 0;
  if (is_real(value)) copy(value, &number, index, 1, place);
  if (!is_real(value) || (number != 0 && number != 1)) place.wrong("true or false", value);
  return static_cast<cairn_bool>(number);
}

inline std::string read_text(const mxArray* value, const Place& place) {
  if (!mxIsChar(value)) place.wrong("a text", value);
  char* text = mxArrayToString(value);
  if (!text) place.wrong("a text of one line", value);
  std::string copied(text);
  mxFree(text);
  return copied;
}

// A constant by its value or by its name: 2, "sparse", "SPARSE", "CAIRN_JOIN_SPARSE".
template <typename To>
To read_constant(const mxArray* value, const Enum& constants, const Place& place) {
  if (!mxIsChar(value)) return read_scalar<To>(value, place);
  std::string name = read_text(value, place);
  const std::string given = name;
  for (char& letter : name)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  if (name.rfind(constants.prefix, 0) == 0) name.erase(0, std::strlen(constants.prefix));
  std::string all;
  for (size_t i = 0; i < constants.count; ++i) {
    if (name == constants.values[i].name) return static_cast<To>(constants.values[i].value);
    all += (i ? ", " : "") + std::string(constants.values[i].name);
  }
  fail("ARGUMENT", "%s: %s must be one of %s, and is \"%s\"", place.call.c_str(), place.name.c_str(), all.c_str(),
       given.c_str());
}

void read_object(const mxArray* value, const Struct& type, void* to, size_t stride, size_t count, const Place& place);

// A field of `count` elements that lie `stride` bytes apart.
inline void read_field(const mxArray* value, const Field& field, char* to, size_t stride, size_t count,
                       const Place& place) {
  if (field.kind == Kind::object) return read_object(value, *field.object, to, stride, count, place);
  if (field.kind == Kind::constant && mxIsChar(value) && count == 1) {
    *reinterpret_cast<int32_t*>(to) = read_constant<int32_t>(value, *field.constants, place);
    return;
  }
  const bool logical = field.kind == Kind::boolean && mxIsLogical(value);
  const size_t rows = field.rows ? field.rows : field.length, columns = field.length / rows;
  bool fits = (is_real(value) || logical) && mxGetNumberOfElements(value) == field.length * count;
  if (fits && field.length == 1) {
    fits = is_vector(value);
  } else if (fits && count == 1 && columns == 1) {
    fits = is_vector(value);
  } else if (fits && count > 0) {
    const mwSize dimensions = mxGetNumberOfDimensions(value);
    fits = size(value, 0) == rows && (columns == 1 ? dimensions == 2 : size(value, 1) == columns && dimensions <= 3);
  }
  if (!fits) {
    std::string expected = field.length == 1 ? "" : std::to_string(rows) + " x ";
    if (columns > 1) expected += std::to_string(columns) + " x ";
    place.wrong(expected + std::to_string(count) + " numbers", value);
  }
  for (size_t i = 0; i < count; ++i, to += stride) {
    switch (field.kind) {
      case Kind::number:
        if (columns == 1) {
          copy(value, reinterpret_cast<double*>(to), i * rows, rows, place);
        } else {
          for (size_t row = 0; row < rows; ++row)
            for (size_t column = 0; column < columns; ++column)
              copy(value, reinterpret_cast<double*>(to) + row * columns + column,
                   i * field.length + column * rows + row, 1, place);
        }
        break;
      case Kind::id:
        copy(value, reinterpret_cast<uint64_t*>(to), i, 1, place);
        break;
      case Kind::uint32:
      case Kind::bits:
        copy(value, reinterpret_cast<uint32_t*>(to), i, 1, place);
        break;
      case Kind::boolean:
        *reinterpret_cast<cairn_bool*>(to) = read_bool(value, i, place);
        break;
      default:
        copy(value, reinterpret_cast<int32_t*>(to), i, 1, place);
    }
  }
}

// Writes only the fields that the struct of Octave has.
inline void read_object(const mxArray* value, const Struct& type, void* to, size_t stride, size_t count,
                        const Place& place) {
  if (!mxIsStruct(value) || mxGetNumberOfElements(value) != 1) place.wrong("a struct", value);
  int known = 0;
  for (size_t i = 0; i < type.count; ++i) {
    const Field& field = type.fields[i];
    const mxArray* part = mxGetField(value, 0, field.name);
    if (!part) continue;
    ++known;
    read_field(part, field, static_cast<char*>(to) + field.offset, stride, count, place.in(field.name));
  }
  for (int i = 0; known != mxGetNumberOfFields(value) && i < mxGetNumberOfFields(value); ++i) {
    const std::string name = mxGetFieldNameByNumber(value, i);
    bool found = false;
    for (size_t j = 0; j < type.count; ++j) found = found || name == type.fields[j].name;
    if (!found) fail("ARGUMENT", "%s: %s has no field \"%s\"", place.call.c_str(), place.name.c_str(), name.c_str());
  }
}

// How many elements a struct has whose fields have a column for each of them: its first field says so.
inline size_t elements(const mxArray* value, const Struct& type, const Place& place) {
  for (size_t i = 0; i < type.count; ++i) {
    const mxArray* part = mxGetField(value, 0, type.fields[i].name);
    if (part && type.fields[i].kind == Kind::object) return elements(part, *type.fields[i].object, place);
    if (part) return mxGetNumberOfElements(part) / type.fields[i].length;
  }
  return 0;
}

template <typename To>
std::vector<To> read_objects(const mxArray* value, const Struct& type, const Place& place) {
  if (mxIsStruct(value) && mxGetNumberOfElements(value) == 1) {
    std::vector<To> objects(elements(value, type, place), To{});
    read_object(value, type, objects.data(), sizeof(To), objects.size(), place);
    return objects;
  }
  if (mxGetNumberOfElements(value) != 0) place.wrong("one struct, whose fields have a column for each element", value);
  return {};
}

inline mxArray* number(double value) {
  return mxCreateDoubleScalar(value);
}

inline mxArray* write_ids(const uint64_t* values, size_t count) {
  mxArray* array = mxCreateNumericMatrix(1, count, mxUINT64_CLASS, mxREAL);
  if (count) std::memcpy(mxGetData(array), values, count * sizeof *values);
  return array;
}

inline mxArray* write_bytes(const uint8_t* values, size_t count) {
  mxArray* array = mxCreateNumericMatrix(1, count, mxUINT8_CLASS, mxREAL);
  if (count) std::memcpy(mxGetData(array), values, count);
  return array;
}

// `columns` vectors of `rows` numbers each, one after the other.
inline mxArray* write_columns(const double* values, size_t rows, size_t columns) {
  mxArray* array = mxCreateDoubleMatrix(rows, columns, mxREAL);
  if (rows > 0 && columns > 0) std::memcpy(mxGetPr(array), values, rows * columns * sizeof *values);
  return array;
}

inline void transpose(const double* row_major, double* to, size_t rows, size_t columns) {
  for (size_t row = 0; row < rows; ++row)
    for (size_t column = 0; column < columns; ++column) to[column * rows + row] = row_major[row * columns + column];
}

inline mxArray* write_matrix(const double* row_major, size_t rows, size_t columns) {
  mxArray* array = mxCreateDoubleMatrix(rows, columns, mxREAL);
  transpose(row_major, mxGetPr(array), rows, columns);
  return array;
}

inline mxArray* write_object(const Struct& type, const void* from, size_t stride, size_t count);

inline mxArray* write_field(const Field& field, const char* from, size_t stride, size_t count) {
  if (field.kind == Kind::object) return write_object(*field.object, from, stride, count);
  if (field.kind == Kind::id) {
    mxArray* array = mxCreateNumericMatrix(1, count, mxUINT64_CLASS, mxREAL);
    auto* to = static_cast<uint64_t*>(mxGetData(array));
    for (size_t i = 0; i < count; ++i) to[i] = *reinterpret_cast<const uint64_t*>(from + i * stride);
    return array;
  }
  if (field.kind == Kind::boolean) {
    mxArray* array = mxCreateLogicalMatrix(1, count);
    for (size_t i = 0; i < count; ++i)
      mxGetLogicals(array)[i] = *reinterpret_cast<const cairn_bool*>(from + i * stride) != 0;
    return array;
  }
  const size_t rows = field.rows ? field.rows : field.length, columns = field.length / rows;
  const mwSize sizes[3] = {static_cast<mwSize>(rows), static_cast<mwSize>(columns), static_cast<mwSize>(count)};
  mxArray* array =
      columns == 1 ? mxCreateDoubleMatrix(rows, count, mxREAL) : mxCreateNumericArray(3, sizes, mxDOUBLE_CLASS, mxREAL);
  double* to = mxGetPr(array);
  for (size_t i = 0; i < count; ++i, to += field.length, from += stride) {
    switch (field.kind) {
      case Kind::number:
        transpose(reinterpret_cast<const double*>(from), to, rows, columns);
        break;
      case Kind::uint32:
      case Kind::bits:
        *to = *reinterpret_cast<const uint32_t*>(from);
        break;
      default:
        *to = *reinterpret_cast<const int32_t*>(from);
    }
  }
  return array;
}

inline mxArray* write_object(const Struct& type, const void* from, size_t stride, size_t count) {
  std::vector<const char*> names(type.count);
  for (size_t i = 0; i < type.count; ++i) names[i] = type.fields[i].name;
  mxArray* object = mxCreateStructMatrix(1, 1, static_cast<int>(type.count), names.data());
  for (size_t i = 0; i < type.count; ++i)
    mxSetFieldByNumber(
        object, 0, static_cast<int>(i),
        write_field(type.fields[i], static_cast<const char*>(from) + type.fields[i].offset, stride, count));
  return object;
}

template <typename From>
mxArray* write_objects(const Struct& type, const std::vector<From>& from) {
  return write_object(type, from.data(), sizeof(From), from.size());
}

}  // namespace cairn_octave
