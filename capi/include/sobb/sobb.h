/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sobb.h
 * @brief SOBB: bounding volume hierarchies of skewed oriented bounding boxes, on the CPU.
 *
 * Build a hierarchy over triangles, save it to one compact file, open that file, trace rays through
 * it. Plain C99: opaque handles, fixed-width types, a status from every call, no globals to set up.
 *
 *     sobb_triangles mesh = SOBB_TRIANGLES_INIT;
 *     sobb_hierarchy* hierarchy = NULL;
 *     mesh.vertices = vertices;  mesh.vertex_count = vertex_count;
 *     mesh.indices = indices;    mesh.triangle_count = triangle_count;
 *     if (sobb_build(&mesh, NULL, &hierarchy) != SOBB_OK) { puts(sobb_last_error()); return 1; }
 *     sobb_intersect(hierarchy, rays, ray_count, hits, NULL);
 *     sobb_release(hierarchy);
 *
 * **Structs that grow.** Option and information structs begin with `struct_size`, the size of the
 * struct. Each has an initialiser that sets it and leaves the rest zero:
 *
 *     sobb_build_options options = SOBB_BUILD_OPTIONS_INIT;
 *
 * A member counts when `struct_size` covers it; members beyond it take their default. In option
 * structs zero means the default, and a NULL pointer to options means all defaults. A `struct_size`
 * too small for the first member, or larger than this library knows with a non-zero byte in the
 * unknown part, is SOBB_ERROR_INVALID_ARGUMENT.
 *
 * **Errors.** Every call that can fail returns a sobb_status; sobb_last_error() has the message of
 * the calling thread's last failed call. On failure outputs are untouched unless a function says
 * otherwise. No exception, `exit` or `abort` crosses this interface. Compilers that can warn where
 * a status is ignored do so; a cast to void says that it is meant.
 *
 * **Threads.** All functions may be called from any thread at any time. A hierarchy is immutable:
 * any number of threads may trace, save and query one at once. Calls restore the floating-point
 * control word (rounding, flush-to-zero) that they found, and do not depend on it.
 *
 * **Results** are the same bits from every instruction set, node width, mode and thread count: the
 * closest hit is the smallest `t`; of equal `t`, the lowest primitive index.
 */
#ifndef SOBB_SOBB_H
#define SOBB_SOBB_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * SOBB_API marks the functions that the library exports and its users import. Windows tells the two
 * apart: the library's own build defines SOBB_EXPORTS, and a program that links the static library
 * defines SOBB_STATIC, as the CMake package does for it.
 */
#if !defined(_WIN32)
#define SOBB_API __attribute__((visibility("default")))
#elif defined(SOBB_STATIC)
#define SOBB_API
#elif defined(SOBB_EXPORTS)
#define SOBB_API __declspec(dllexport)
#else
#define SOBB_API __declspec(dllimport)
#endif

/*
 * SOBB_NODISCARD marks the functions whose status must not be ignored. GCC's own attribute warns of
 * a cast to void as well, so GCC gets the standard one, which it knows in every version of C and
 * C++.
 */
#if defined(__cplusplus) && __cplusplus >= 201703L
#define SOBB_NODISCARD [[nodiscard]]
#elif defined(_MSVC_LANG) && _MSVC_LANG >= 201703L
#define SOBB_NODISCARD [[nodiscard]]
#elif defined(__clang__)
#define SOBB_NODISCARD __attribute__((warn_unused_result))
#elif defined(__GNUC__) && __GNUC__ >= 10
#define SOBB_NODISCARD __extension__ [[nodiscard]]
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 202311L
#define SOBB_NODISCARD [[nodiscard]]
#else
#define SOBB_NODISCARD
#endif

/** Semantic version of this header; sobb_version() is that of the library that was linked. */
#define SOBB_VERSION_MAJOR 0
#define SOBB_VERSION_MINOR 1
#define SOBB_VERSION_PATCH 0
/** The soname's number: raised when a program built before would not run with a library after. */
#define SOBB_ABI_VERSION 0

/* ------------------------------------------------------------------------------- status -- */

/** The outcome of a call. Values are fixed for ever; new causes get new ones. */
typedef enum sobb_status {
  SOBB_OK = 0,

  SOBB_ERROR_INVALID_ARGUMENT = 1, /**< a NULL pointer, a value out of range, a wrong struct_size */
  SOBB_ERROR_EMPTY = 2,            /**< no triangle at all */
  SOBB_ERROR_INDEX = 3,            /**< a triangle names a vertex that does not exist */
  SOBB_ERROR_NOT_FINITE = 4,       /**< a vertex coordinate is NaN or infinite */
  SOBB_ERROR_TOO_LARGE = 5,        /**< a coordinate beyond 2^60, or more than SOBB_MAX_TRIANGLES */
  SOBB_ERROR_OUT_OF_MEMORY = 6,    /**< an allocation failed */
  SOBB_ERROR_MEMORY_LIMIT = 7,     /**< the caller's memory limit would be exceeded */
  SOBB_ERROR_CANCELLED = 8,        /**< the progress callback asked to stop */
  SOBB_ERROR_UNSUPPORTED_CPU = 9,  /**< this processor lacks the instruction set asked for */
  SOBB_ERROR_INTERNAL = 10,        /**< a defect of the library or of one below it */

  SOBB_ERROR_FILE_OPEN = 20,  /**< a file is missing, is no regular file, or may not be opened */
  SOBB_ERROR_FILE_READ = 21,  /**< reading failed half-way */
  SOBB_ERROR_FILE_WRITE = 22, /**< writing failed (disk full, read-only folder); nothing replaced */

  SOBB_ERROR_FORMAT_MAGIC = 30,     /**< not a .sobb file */
  SOBB_ERROR_FORMAT_VERSION = 31,   /**< a version that this library does not read */
  SOBB_ERROR_FORMAT_FEATURE = 32,   /**< needs a feature that this library does not have */
  SOBB_ERROR_FORMAT_SIZE = 33,      /**< truncated, or with bytes after its end */
  SOBB_ERROR_FORMAT_HEADER = 34,    /**< a header field out of range, or its checksum differs */
  SOBB_ERROR_FORMAT_SECTION = 35,   /**< a section missing, overlapping, misaligned, out of range */
  SOBB_ERROR_FORMAT_CHECKSUM = 36,  /**< a section's bytes differ from its checksum */
  SOBB_ERROR_FORMAT_TABLE = 37,     /**< the direction table is not of unit vectors */
  SOBB_ERROR_FORMAT_NODE = 38,      /**< a node's slab, basis or meta word is not possible */
  SOBB_ERROR_FORMAT_REFERENCE = 39, /**< a reference out of range, backward, met twice or never */
  SOBB_ERROR_FORMAT_DEPTH = 40,     /**< deeper than any traversal stack */
  SOBB_ERROR_FORMAT_TRIANGLE = 41,  /**< a triangle block with an impossible vertex or primitive */
  SOBB_ERROR_FORMAT_RECORD = 42,    /**< the build record has a value out of range */

  SOBB_ERROR_SCENE_FORMAT = 60,      /**< a file format that no importer knows */
  SOBB_ERROR_SCENE_SYNTAX = 61,      /**< a scene file or name that is malformed or inconsistent */
  SOBB_ERROR_SCENE_UNSUPPORTED = 62, /**< a scene file that requires a feature we lack (named) */
  SOBB_ERROR_SCENE_REFERENCE = 63    /**< a file that the scene needs is missing or too short */
} sobb_status;

/** The status in words, e.g. "out of memory". A static string, never NULL. Thread-safe. */
SOBB_API const char* sobb_status_string(sobb_status status);

/**
 * The message of the last call that failed on this thread, with the file, the place and the cause;
 * "" if none did. Valid until this thread's next failing call. Successful calls leave it alone.
 */
SOBB_API const char* sobb_last_error(void);

/** The library's version, (major << 16) | (minor << 8) | patch. Thread-safe, constant. */
SOBB_API uint32_t sobb_version(void);

/* ---------------------------------------------------------------------- host's services -- */

/**
 * Instruction sets of the kernels. Results do not depend on the choice, only speed does. The sets
 * are the values 1 to sobb_isa_count(), so a program needs no list of its own:
 *
 *     for (uint32_t isa = 1; isa <= sobb_isa_count(); ++isa) puts(sobb_isa_title(isa));
 */
typedef enum sobb_isa {
  SOBB_ISA_BEST = 0, /**< the one that the environment's SOBB_ISA names if set, else the best */
  SOBB_ISA_SSE4 = 1, /**< SSE4.2, 128-bit vectors; the least that the library runs on */
  SOBB_ISA_AVX2 = 2  /**< AVX2 and FMA, 256-bit vectors */
} sobb_isa;

/**
 * The number of instruction sets that the library has kernels for, whether or not this processor
 * has them (sobb_resolve_isa() tells). Thread-safe, constant.
 */
SOBB_API uint32_t sobb_isa_count(void);

/**
 * The name of a sobb_isa on command lines and in the environment's SOBB_ISA, such as
 * "avx2"; "best" for SOBB_ISA_BEST, "unknown" for a value that is no sobb_isa. A static string,
 * never NULL. Thread-safe, O(1).
 */
SOBB_API const char* sobb_isa_name(uint32_t isa);

/**
 * The name of a sobb_isa for people, such as "SSE4.2"; "best" and "unknown" as sobb_isa_name()
 * has them. A static string, never NULL. Thread-safe, O(1).
 */
SOBB_API const char* sobb_isa_title(uint32_t isa);

/**
 * The value that a name of sobb_isa_name() stands for, such as one from a command line.
 * @param name "best" or the name of a set, in lower case.
 * @param out the value; it is not resolved, and this processor may lack the set.
 * @return SOBB_ERROR_INVALID_ARGUMENT for any other name; the message lists the names. Thread-safe.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_isa_from_name(const char* name, sobb_isa* out);

/**
 * Resolves SOBB_ISA_BEST (or checks another) on this processor.
 * @param isa what to resolve.
 * @param out the set that calls with @p isa will use; never SOBB_ISA_BEST.
 * @return SOBB_ERROR_UNSUPPORTED_CPU, or SOBB_ERROR_INVALID_ARGUMENT for an unknown value (of the
 *         environment's variable too). Thread-safe, O(1).
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_resolve_isa(sobb_isa isa, sobb_isa* out);

/**
 * The caller's allocator. Every allocation of the library on behalf of a call that was given one
 * goes through it, as do those that the resulting hierarchy keeps and those of tracing it, but for
 * some hundred bytes of bookkeeping, and what TBB keeps for its threads.
 * Called from several threads at once.
 */
typedef struct sobb_allocator {
  void* user;
  /** Returns @p size bytes aligned to @p alignment (a power of two), or NULL. */
  void* (*allocate)(void* user, size_t size, size_t alignment);
  /** Takes back what allocate returned, with the same size and alignment. */
  void (*deallocate)(void* user, void* pointer, size_t size, size_t alignment);
} sobb_allocator;

/**
 * The caller's thread pool. `parallel_for` runs body(context, i) once for each i < count, on any
 * threads, in any order, and returns when all are done. Bodies do not throw and do not block on
 * each other.
 * A build with a scheduler starts no thread of its own.
 */
typedef struct sobb_scheduler {
  void* user;
  void (*parallel_for)(void* user, uint64_t count, void (*body)(void* context, uint64_t index),
                       void* context);
} sobb_scheduler;

/* ------------------------------------------------------------------------ triangles in -- */

/** The most triangles of a mesh: 2^32 - 3, since two values of sobb_hit::primitive are none. */
#define SOBB_MAX_TRIANGLES 0xFFFFFFFDu

/**
 * Indexed triangles, borrowed for the length of a call. No alignment is asked beyond `float`'s.
 * Degenerate triangles keep their index and are never hit.
 */
typedef struct sobb_triangles {
  uint32_t struct_size;
  uint32_t reserved;       /**< zero */
  const float* vertices;   /**< x, y, z of vertex i at byte i * vertex_stride */
  uint64_t vertex_count;   /**< at most 2^32 */
  uint64_t vertex_stride;  /**< bytes from vertex to vertex, a multiple of 4; 0 means 12 */
  const uint32_t* indices; /**< three per triangle, tightly packed */
  uint64_t triangle_count; /**< 1 to SOBB_MAX_TRIANGLES */
} sobb_triangles;
#define SOBB_TRIANGLES_INIT \
  { sizeof(sobb_triangles), 0, NULL, 0, 0, NULL, 0 }

/* ------------------------------------------------------------------------------- build -- */

typedef struct sobb_hierarchy sobb_hierarchy; /**< immutable, reference-counted */

/** The bounding volume of a hierarchy's children. */
typedef enum sobb_volume {
  SOBB_VOLUME_DEFAULT = 0, /**< SOBB */
  SOBB_VOLUME_AABB = 1,    /**< axis-aligned boxes, for comparison: same nodes, own kernel */
  SOBB_VOLUME_SOBB = 2     /**< skewed oriented boxes of k/2 directions, where they pay */
} sobb_volume;

/** The topology builder's effort. */
typedef enum sobb_quality {
  SOBB_QUALITY_DEFAULT = 0, /**< medium */
  SOBB_QUALITY_LOW = 1,     /**< a grid in Morton order, then splits in the middle */
  SOBB_QUALITY_MEDIUM = 2,  /**< binned surface area heuristic, then a little reinsertion */
  SOBB_QUALITY_HIGH = 3     /**< with spatial splits or without, whichever is cheaper; more of it */
} sobb_quality;

/** How a basis is chosen among the k/2 directions (EG25, section 4). */
typedef enum sobb_strategy {
  SOBB_STRATEGY_DEFAULT = 0, /**< k^2. With every strategy the table's frame competes too */
  SOBB_STRATEGY_K = 1,  /**< the narrowest slab, the best second to it, the best third to both */
  SOBB_STRATEGY_K2 = 2, /**< the narrowest slab, then all pairs */
  SOBB_STRATEGY_K3 = 3  /**< all triples */
} sobb_strategy;

/** The table of directions that SOBBs take theirs from. */
typedef enum sobb_table {
  SOBB_TABLE_DEFAULT = 0, /**< fitted; of AABBs, whose directions are the axes, spread */
  SOBB_TABLE_SPREAD = 1,  /**< the library's own set: the axes, and directions spread evenly */
  /**
   * Fitted to the scene: the spread set turned into the frame that the scene's own normals and
   * edges suggest, in which the topology is built too. For walls, floors and machine parts that are
   * turned against the axes; where no frame is better than the axes it is the spread set. Not for
   * the AABB. Costs some 8 ms of one thread at 250,000 triangles, 25 ms at a million.
   */
  SOBB_TABLE_FITTED = 2
} sobb_table;

/** Options of sobb_build(). Zero in a member means its default. */
typedef struct sobb_build_options {
  uint32_t struct_size;
  uint32_t volume;       /**< a sobb_volume */
  uint32_t k;            /**< planes of the k-DOP: 32, 48 or 64 (default); ignored for the AABB */
  uint32_t quality;      /**< a sobb_quality */
  uint32_t strategy;     /**< a sobb_strategy */
  uint32_t width;        /**< children a node: 4 or 8 (default) */
  uint32_t threads;      /**< at most this many; 1 starts none; 0 as many as there are */
  uint32_t isa;          /**< a sobb_isa; never changes the result */
  uint64_t memory_limit; /**< bytes held at once at most; 0 for none */
  const sobb_allocator* allocator; /**< copied; NULL for the library's own */
  const sobb_scheduler* scheduler; /**< NULL for the library's */
  /**
   * Called now and then, from any thread but never from two at once, with the fraction done
   * (0 to 1, not falling). A non-zero return cancels: SOBB_ERROR_CANCELLED. NULL for none.
   */
  int (*progress)(void* user, double fraction);
  void* progress_user;
  uint32_t table;    /**< a sobb_table */
  uint32_t reserved; /**< zero */
} sobb_build_options;
#define SOBB_BUILD_OPTIONS_INIT \
  { sizeof(sobb_build_options), 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, 0, 0 }

/**
 * Builds a hierarchy over triangles; the input may be freed afterwards.
 *
 * The same triangles and options give the same bytes, for any thread count and instruction set.
 *
 * @param triangles the input.
 * @param options NULL for the defaults.
 * @param out the new handle, with one reference, to be given to sobb_release().
 * @return SOBB_ERROR_INVALID_ARGUMENT, _EMPTY, _INDEX (the message names the triangle),
 *         _NOT_FINITE, _TOO_LARGE (the vertex), _OUT_OF_MEMORY, _MEMORY_LIMIT, _CANCELLED,
 *         _UNSUPPORTED_CPU, _INTERNAL.
 * Cost: O(n log n); about 60 bytes per triangle are kept, see docs/c-api.md for the peak.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_build(const sobb_triangles* triangles,
                                               const sobb_build_options* options,
                                               sobb_hierarchy** out);

/** Adds a reference. NULL is allowed. Returns its argument. */
SOBB_API sobb_hierarchy* sobb_retain(sobb_hierarchy* hierarchy);
/** Drops a reference; the last frees the hierarchy. NULL is allowed. */
SOBB_API void sobb_release(sobb_hierarchy* hierarchy);

/* -------------------------------------------------------------------------------- file -- */

/** Bits of sobb_open_options::flags. */
enum {
  /**
   * Trace the file where it lies, mapped read-only, instead of a private copy. The caller promises
   * that nobody changes or truncates the file while the hierarchy lives: a truncated mapping is a
   * bus error, and what changes after validation is not checked again.
   */
  SOBB_OPEN_MAP = 1
};

/** Options of sobb_open() and sobb_open_memory(). Zero in a member means its default. */
typedef struct sobb_open_options {
  uint32_t struct_size;
  uint32_t flags;        /**< SOBB_OPEN_ bits */
  uint32_t threads;      /**< for checksums and validation; as in sobb_build_options */
  uint32_t reserved;     /**< zero */
  uint64_t memory_limit; /**< bytes that opening may hold at once; 0 for none */
  const sobb_allocator* allocator;
  const sobb_scheduler* scheduler;
  /** Progress as in sobb_build_options, called about once per MiB, so that it can keep a time
   * limit. */
  int (*progress)(void* user, double fraction);
  void* progress_user;
} sobb_open_options;
#define SOBB_OPEN_OPTIONS_INIT \
  { sizeof(sobb_open_options), 0, 0, 0, 0, NULL, NULL, NULL, NULL }

/**
 * Writes the hierarchy to a file (docs/format.md), atomically: to a temporary name beside it,
 * synced to the disk, then renamed. Whatever happens, @p path is the old file or the new. A process
 * that is killed may leave its temporary, `.sobb-N.tmp`; the next save in that folder removes it.
 * @return SOBB_ERROR_FILE_WRITE with the path and the system's reason; SOBB_ERROR_OUT_OF_MEMORY.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_save(const sobb_hierarchy* hierarchy, const char* path);

/**
 * Opens a file and proves it safe to trace: sizes, checksums, every reference, slab and triangle.
 * A file that fails is refused with one status a cause and a message that names file and place.
 * @return SOBB_ERROR_FILE_OPEN, _FILE_READ, any _FORMAT_, _OUT_OF_MEMORY, _MEMORY_LIMIT,
 *         _CANCELLED.
 * Cost: reads the file once; O(size) in time, and its size in memory (none to speak of if mapped).
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_open(const char* path, const sobb_open_options* options,
                                              sobb_hierarchy** out);

/** The same from memory, which is copied; SOBB_OPEN_MAP is SOBB_ERROR_INVALID_ARGUMENT here. */
SOBB_NODISCARD SOBB_API sobb_status sobb_open_memory(const void* data, uint64_t size,
                                                     const sobb_open_options* options,
                                                     sobb_hierarchy** out);

/**
 * The bytes that sobb_save() writes, where they lie: owned by the hierarchy, valid while it lives.
 * Cost: O(1), nothing is copied.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_bytes(const sobb_hierarchy* hierarchy, const void** data,
                                               uint64_t* size);

/** What a hierarchy is; filled by sobb_get_info(). Sums over nodes are made at the call. */
typedef struct sobb_info {
  uint32_t struct_size;
  uint32_t format_version;
  uint32_t volume;     /**< a sobb_volume */
  uint32_t k;          /**< planes of the direction table; 6 for the AABB */
  uint32_t quality;    /**< a sobb_quality, as built */
  uint32_t strategy;   /**< a sobb_strategy, as built */
  uint32_t width;      /**< children a node at most */
  uint32_t depth;      /**< nodes on the longest way down, the root counted */
  uint64_t triangles;  /**< of the input, degenerate ones included */
  uint64_t degenerate; /**< of those, the ones without area */
  uint64_t references; /**< in leaves; more than triangles after spatial splits */
  uint64_t nodes;
  uint64_t leaves;
  uint64_t blocks;       /**< of four triangles */
  uint64_t axes_nodes;   /**< nodes whose shared basis is the axes (of a fitted table, its frame) */
  uint64_t shared_nodes; /**< nodes with another basis shared by all children */
  uint64_t own_nodes;    /**< nodes with a basis for each child */
  uint64_t bytes;        /**< of the file, and in memory */
  uint64_t node_bytes;
  uint64_t triangle_bytes;
  uint64_t source_hash; /**< of the input's vertices and indices as used (docs/format.md) */
  float bounds_min[3];  /**< the input's box */
  float bounds_max[3];
  double inner_area; /**< sum of the inner children's areas over the box's area */
  double leaf_area;  /**< sum of the leaves' areas over the box's area */
  /* The build took these milliseconds and bytes; zero for a hierarchy that was opened. */
  double topology_ms; /**< a fitted table and the binary hierarchy */
  double collapse_ms; /**< binary to wide */
  double volume_ms;   /**< k-DOPs, volumes, nodes and triangle blocks */
  double total_ms;
  uint64_t peak_bytes; /**< the most held at once */
  uint32_t table;      /**< SOBB_TABLE_SPREAD for the library's own directions, else _FITTED */
  uint32_t reserved;   /**< zero */
} sobb_info;
#define SOBB_INFO_INIT                                                                        \
  {                                                                                           \
    sizeof(sobb_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, {0, 0, 0}, \
        {0, 0, 0}, 0, 0, 0, 0, 0, 0, 0, 0, 0                                                  \
  }

/** Fills @p info up to its struct_size. Thread-safe. Cost: O(nodes). */
SOBB_NODISCARD SOBB_API sobb_status sobb_get_info(const sobb_hierarchy* hierarchy, sobb_info* info);

/* ------------------------------------------------------------------------------- trace -- */

/**
 * A ray, 32 bytes: the points origin + t * direction with tmin <= t <= tmax (closed interval).
 * `direction` may have any length but zero; t is in its units. `tmin` is at least 0; `tmax` may be
 * infinite; a ray with tmin > tmax, or with tmin infinite, misses. Triangles are two-sided.
 */
typedef struct sobb_ray {
  float origin[3];
  float tmin;
  float direction[3];
  float tmax;
} sobb_ray;

#define SOBB_MISS 0xFFFFFFFFu    /**< sobb_hit::primitive of a ray that hit nothing */
#define SOBB_INVALID 0xFFFFFFFEu /**< of a ray with NaN, infinity, no direction, or tmin < 0 */

/**
 * A hit, 24 bytes. The point is (1-u-v) v0 + u v1 + v v2, and within rounding origin + t direction.
 * A miss, and an invalid ray, have t = infinity, u = v = 0.
 */
typedef struct sobb_hit {
  float t;
  float u;
  float v;
  uint32_t primitive; /**< index of the triangle in the input, SOBB_MISS or SOBB_INVALID */
  uint32_t geometry;  /**< 0; SOBB_MISS where nothing was hit. For later versions */
  uint32_t instance;  /**< SOBB_MISS. For later versions */
} sobb_hit;

/** Work done for a ray, for statistics and heat maps. */
typedef struct sobb_count {
  uint32_t nodes;     /**< wide nodes visited */
  uint32_t volumes;   /**< children's volumes tested */
  uint32_t blocks;    /**< triangle blocks tested */
  uint32_t triangles; /**< triangles in them */
} sobb_count;

/** Bits of sobb_trace_options::flags. */
enum {
  /** Neighbours in the array are alike (primary rays in tiles): begin with 64 of them at a time. */
  SOBB_TRACE_COHERENT = 1
};

/** Options of the tracing calls. Zero in a member means its default. */
typedef struct sobb_trace_options {
  uint32_t struct_size;
  uint32_t flags;                  /**< SOBB_TRACE_ bits; never change the result */
  uint32_t threads;                /**< at most this many; 1 starts none; 0 as many as there are */
  uint32_t isa;                    /**< a sobb_isa; never changes the result */
  sobb_count* counts;              /**< one per ray, or NULL; asks for the single-ray kernel */
  uint64_t* invalid_rays;          /**< receives how many rays were SOBB_INVALID, or NULL */
  const sobb_scheduler* scheduler; /**< NULL for the library's */
} sobb_trace_options;
#define SOBB_TRACE_OPTIONS_INIT \
  { sizeof(sobb_trace_options), 0, 0, 0, NULL, NULL, NULL }

/** Value of an occlusion byte. */
enum { SOBB_FREE = 0, SOBB_OCCLUDED = 1, SOBB_OCCLUDED_INVALID = 255 };

/**
 * Closest hits of an array of rays.
 * @param rays @p count rays; no alignment is asked beyond `float`'s.
 * @param hits @p count hits, written in the order of the rays. May not overlap @p rays.
 * @return SOBB_ERROR_INVALID_ARGUMENT or SOBB_ERROR_UNSUPPORTED_CPU. A ray that is not valid gets
 *         SOBB_INVALID and is counted; the others are traced all the same.
 * Without counts, 256 rays and more are traced together, in tasks of 2048, in whichever of three
 * modes the call finds the fastest. They take about a megabyte per thread of the hierarchy's
 * allocator while the call runs. Without that memory, and in all other cases, rays are traced one
 * by one, or 64 at a time with SOBB_TRACE_COHERENT, to the same hits. Cost: about O(log n) per ray.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_intersect(const sobb_hierarchy* hierarchy,
                                                   const sobb_ray* rays, uint64_t count,
                                                   sobb_hit* hits,
                                                   const sobb_trace_options* options);

/**
 * Any hit: whether each ray meets a triangle in its interval. Cheaper than the closest.
 * @param occluded @p count bytes: SOBB_FREE, SOBB_OCCLUDED or SOBB_OCCLUDED_INVALID.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_occluded(const sobb_hierarchy* hierarchy,
                                                  const sobb_ray* rays, uint64_t count,
                                                  uint8_t* occluded,
                                                  const sobb_trace_options* options);

/** The closest hit of one ray, with the best instruction set, on the calling thread. */
SOBB_NODISCARD SOBB_API sobb_status sobb_intersect1(const sobb_hierarchy* hierarchy,
                                                    const sobb_ray* ray, sobb_hit* hit);

/** Tells whether one ray is occluded (a byte as above). */
SOBB_NODISCARD SOBB_API sobb_status sobb_occluded1(const sobb_hierarchy* hierarchy,
                                                   const sobb_ray* ray, uint8_t* occluded);

/**
 * The closest hits of a packet: up to 16 rays traced together, best when they are alike.
 * @param rays 16 rays, or as many as the highest bit of @p mask asks for.
 * @param mask bit i set: ray i is traced and hit i written; others are not touched.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_intersect_packet(const sobb_hierarchy* hierarchy,
                                                          const sobb_ray* rays, uint32_t mask,
                                                          sobb_hit* hits);

/** Any hit of a packet; byte i is written where bit i of @p mask is set. */
SOBB_NODISCARD SOBB_API sobb_status sobb_occluded_packet(const sobb_hierarchy* hierarchy,
                                                         const sobb_ray* rays, uint32_t mask,
                                                         uint8_t* occluded);

/**
 * The oracle: closest hits by trying every triangle, in scalar code, without any hierarchy. Right
 * by definition; the other calls equal it bit by bit. Cost: O(rays * triangles).
 * @param options `threads` and `scheduler` count. May be NULL.
 * @return as sobb_build() for bad triangles, as sobb_intersect() for the rest.
 */
SOBB_NODISCARD SOBB_API sobb_status sobb_brute_force(const sobb_triangles* triangles,
                                                     const sobb_ray* rays, uint64_t count,
                                                     sobb_hit* hits,
                                                     const sobb_trace_options* options);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SOBB_SOBB_H */
