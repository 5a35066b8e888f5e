// SPDX-License-Identifier: BSD-3-Clause
// How the work is cut, from the inside out:
//  - A tile of C, 12 x 4 with 4-lane vectors (4 x 4 with 2-lane ones), is summed up in registers over the whole rank:
//    12 accumulators, 3 vectors of A and one value of B, so that two multiply-adds can start every cycle.
//  - Panels. A is copied into panels of 12 rows, B into panels of 4, each in the order that a tile reads it. A panel is
//    contiguous, and its tail is filled up with zeros, so that tiles at the edges run the same inner loop.
//  - Blocks. A column of tiles runs down as many panels of A as fit into half of a small second-level cache: the panel
//    of B stays in the first-level cache, that block of A in the second, and C streams by once, down four columns at a
//    time, which is what hardware prefetchers follow.
//  - Ranks above `kDepth` are done in slices, so that the workspace stays small.
// Tiles on the diagonal and at the edges are added from a buffer on the stack, entry by entry.
#include "linear/triangle.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/compiler.hpp"
#include "linear/lanes.hpp"

namespace cairn {
namespace {

using Index = std::ptrdiff_t;

#if defined(__AVX__)
constexpr Index kLanes = 4;
constexpr Index kGroups = 3;  // groups of kColumns rows in a tile
constexpr Index kSpread = 1;  // one value is broadcast to all lanes while it is loaded
#else
constexpr Index kLanes = 2;
constexpr Index kGroups = 1;
constexpr Index kSpread = 2;  // B's panels hold each value twice: SSE2 has no load that broadcasts
#endif
constexpr Index kColumns = 4;
constexpr Index kRows = kGroups * kColumns;
constexpr Index kDepth = 192;
constexpr Index kBlock = 24576;  // doubles of one block of A
constexpr Index kAlign = 8;      // doubles of a cache line
static_assert(kBlock / kDepth >= kRows, "a block holds a panel");

#if defined(CAIRN_VECTOR_TYPES)
typedef double Vector __attribute__((vector_size(kLanes * sizeof(double))));
#else
using Vector = Lanes<kLanes>;
#endif

CAIRN_ALWAYS_INLINE Vector load(const double* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

CAIRN_ALWAYS_INLINE void store(double* to, Vector v) {
  std::memcpy(to, &v, sizeof v);
}

constexpr Index round_up(Index value, Index step) {
  return (value + step - 1) / step * step;
}

// A column of A or of B, from its first row, and the factor that it is packed with.
struct Column {
  const double* value;
  double factor;
};

// Rows `row` to `row + kHeight` of k columns of n rows, zeros beyond the last.
template <Index kHeight>
void pack_panel(const Column* columns, Index n, Index k, Index row, double* panel) {
  for (Index p = 0; p < k; ++p, panel += kHeight) {
    const double* column = columns[p].value + row;
    const double factor = columns[p].factor;
    if (row + kHeight <= n) {
      for (Index i = 0; i < kHeight; i += kLanes) store(panel + i, factor * load(column + i));
    } else {
      for (Index i = 0; i < kHeight; ++i) panel[i] = row + i < n ? factor * column[i] : 0.0;
    }
  }
}

// Rows `first` to `last`.
template <Index kHeight>
void pack(const Column* columns, Index first, Index last, Index k, double* panels) {
  for (Index row = first; row < last; row += kHeight, panels += kHeight * k) {
    pack_panel<kHeight>(columns, last, k, row, panels);
  }
}

// Repeats each of `count` values `kSpread` times, in place.
void spread(double* values, Index count) {
  if (kSpread == 1) return;
  for (Index i = count - 1; i >= 0; --i) std::fill_n(values + i * kSpread, kSpread, values[i]);
}

template <Index kTileGroups>
struct Tile {
  static constexpr Index kVectors = kTileGroups * kColumns / kLanes;
  Vector sum[kColumns][kVectors];

  // The loops over constants are unrolled explicitly: the sums must stay in registers, also at -O2.
  CAIRN_ALWAYS_INLINE Tile(const double* a, const double* b, Index k) {
    CAIRN_UNROLL for (Index q = 0; q < kColumns; ++q) {
      CAIRN_UNROLL for (Index v = 0; v < kVectors; ++v) sum[q][v] = Vector{};
    }
    for (Index p = 0; p < k; ++p, a += kRows, b += kColumns * kSpread) {
      Vector x[kVectors];
      CAIRN_UNROLL for (Index v = 0; v < kVectors; ++v) x[v] = load(a + v * kLanes);
      CAIRN_UNROLL for (Index q = 0; q < kColumns; ++q) {
        Vector y;
        if constexpr (kSpread == 1) {
          y = b[q] - Vector{};  // in all lanes
        } else {
          y = load(b + q * kSpread);
        }
        CAIRN_UNROLL for (Index v = 0; v < kVectors; ++v) sum[q][v] += x[v] * y;
      }
    }
  }
};

CAIRN_ALWAYS_INLINE void add_full_tile(const double* a, const double* b, Index k, double* c, Index ldc) {
  CAIRN_UNROLL for (Index q = 0; q < kColumns; ++q) {
    CAIRN_PREFETCH_WRITE(c + q * ldc);
    CAIRN_PREFETCH_WRITE(c + q * ldc + kRows - 1);
  }
  const Tile<kGroups> tile(a, b, k);
  CAIRN_UNROLL for (Index q = 0; q < kColumns; ++q) {
    CAIRN_UNROLL for (Index v = 0; v < tile.kVectors; ++v) {
      double* to = c + q * ldc + v * kLanes;
      store(to, load(to) + tile.sum[q][v]);
    }
  }
}

// The first `rows` and `columns` of a tile; on the diagonal, only the entries that are not above it.
template <Index kTileGroups>
void add_edge_tile(const double* a, const double* b, Index k, double* c, Index ldc, Index rows, Index columns,
                   bool diagonal) {
  constexpr Index kHeight = kTileGroups * kColumns;
  double spill[kColumns * kHeight];
  {
    const Tile<kTileGroups> tile(a, b, k);
    CAIRN_UNROLL for (Index q = 0; q < kColumns; ++q) {
      CAIRN_UNROLL for (Index v = 0; v < tile.kVectors; ++v) store(spill + q * kHeight + v * kLanes, tile.sum[q][v]);
    }
  }
  for (Index q = 0; q < columns; ++q) {
    for (Index i = diagonal ? q : 0; i < rows; ++i) c[i + q * ldc] += spill[q * kHeight + i];
  }
}

void add_edge(const double* a, const double* b, Index k, double* c, Index ldc, Index rows, Index columns,
              bool diagonal) {
  if constexpr (kGroups == 3) {
    if (rows > 2 * kColumns) return add_edge_tile<3>(a, b, k, c, ldc, rows, columns, diagonal);
    if (rows > kColumns) return add_edge_tile<2>(a, b, k, c, ldc, rows, columns, diagonal);
  }
  add_edge_tile<1>(a, b, k, c, ldc, rows, columns, diagonal);
}

// One panel of B against rows `first` to `last` of C, whose panels of A begin at `panels`; columns from `j`.
void add_column(const double* panels, Index first, Index last, const double* b, Index k, double* C, Index ldc, Index j,
                Index columns) {
  Index i = first;
  if (j >= first) {  // the panel that the diagonal crosses, from the row of the diagonal on
    i += (j - first) / kRows * kRows;
    const double* a = panels + (i - first) * k + (j - i);
    add_edge(a, b, k, C + j + j * ldc, ldc, std::min(i + kRows, last) - j, columns, true);
    i += kRows;
  }
  if (columns == kColumns) {
    for (; i + kRows <= last; i += kRows) add_full_tile(panels + (i - first) * k, b, k, C + i + j * ldc, ldc);
  }
  if (i < last) add_edge(panels + (i - first) * k, b, k, C + i + j * ldc, ldc, last - i, columns, false);
}

double* aligned(double* pointer) {
  constexpr std::uintptr_t kMask = kAlign * sizeof(double) - 1;
  return reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(pointer) + kMask) & ~kMask);
}

// lower(C) += A B^T over one slice of columns.
void update_slice(double* C, Index ldc, Index n, const Column* a, const Column* b, Index depth, double* panels_b) {
  const Index height = kBlock / depth / kRows * kRows;
  const Index values_b = round_up(n, kColumns) * depth;
  double* const panels_a = panels_b + round_up(values_b * kSpread, kAlign);
  pack<kColumns>(b, 0, n, depth, panels_b);
  spread(panels_b, values_b);
  for (Index first = 0; first < n; first += height) {
    const Index last = std::min(n, first + height);
    pack<kRows>(a, first, last, depth, panels_a);
    for (Index j = 0; j < last; j += kColumns) {
      add_column(panels_a, first, last, panels_b + j * depth * kSpread, depth, C, ldc, j, std::min(kColumns, n - j));
    }
  }
}

}  // namespace

std::size_t update_triangle_workspace(std::ptrdiff_t n_max, std::ptrdiff_t k_max) {
  const Index panels_b = round_up(n_max, kColumns) * std::min(k_max, kDepth) * kSpread;
  return static_cast<std::size_t>(round_up(panels_b, kAlign) + kBlock + kAlign);
}

void update_triangle(double* C, std::ptrdiff_t ldc, std::ptrdiff_t n, const TriangleTerm* terms, std::ptrdiff_t count,
                     double* workspace) {
  double* const panels_b = aligned(workspace);
  Column a[kDepth], b[kDepth];
  Index depth = 0;
  for (const TriangleTerm* term = terms; term != terms + count; ++term) {
    for (Index p = 0; p < term->k; ++p) {
      a[depth] = {term->A + p * term->lda, term->factor};
      b[depth] = {term->B + p * term->ldb, 1.0};
      if (++depth == kDepth) {
        update_slice(C, ldc, n, a, b, depth, panels_b);
        depth = 0;
      }
    }
  }
  if (depth > 0) update_slice(C, ldc, n, a, b, depth, panels_b);
}

void update_triangle(double* C, std::ptrdiff_t ldc, std::ptrdiff_t n, const double* A, std::ptrdiff_t lda,
                     const double* B, std::ptrdiff_t ldb, std::ptrdiff_t k, double* workspace) {
  const TriangleTerm term{A, lda, B, ldb, k, 1.0};
  update_triangle(C, ldc, n, &term, 1, workspace);
}

}  // namespace cairn
