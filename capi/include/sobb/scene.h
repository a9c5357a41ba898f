/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file scene.h
 * @brief Triangles in: scene files and built-in scenes, for tools. A second library (sobb_scene),
 *        so that a program that only traces links no importer.
 *
 * Formats, told by the file's ending: glTF 2.0 (.gltf, .glb), OBJ, PLY, STL, OFF. Every triangle of
 * the file counts, in the file's order; degenerate triangles are kept and counted. A polygon of n
 * corners becomes n - 2 triangles: the fan about its first corner where that covers it, as it does
 * convex ones, else others that cover it. Materials, textures, animation and skins are ignored,
 * images never decoded. A bad item that the triangles do not need costs that item and a note, never
 * the scene: see sobb_scene_note.
 *
 * glTF: every node of the default scene, one of several parents below each, but those that
 * KHR_node_visibility hides; positions as default weights of morph targets displace them.
 * KHR_draco_mesh_compression and EXT_meshopt_compression (KHR_meshopt_compression) are decoded
 * where the library was built with libdraco and libmeshoptimizer, else refused by name unless the
 * file has the elements uncompressed too. Required extensions that move no triangle are noted;
 * those that may are refused by name.
 *
 * Built-in scenes: `builtin:NAME[:TRIANGLES][@DEGREES]` with NAME one of hairball, wool, pipes,
 * foliage, city, terrain; 250,000 triangles unless said, as near as the scene's parts allow and
 * never more. The same name gives the same bits on every machine.
 *
 * Turned scenes: `@DEGREES` (-360 to 360) after a built-in scene's name, or after a path, turns the
 * triangles and all views alike about the oblique axis (1, 2, 3): `city.glb@30`. It goes through
 * the centre of the file's box, or one of the built-in scene's own. A file whose name is the whole
 * text wins.
 *
 * Refined scenes: `^TIMES` (4, 16 or 64) behind the name or path, before a turn, subdivides every
 * triangle into so many: `bunny.ply^16`, `builtin:city:1000^4@30`. The surface is that of C. Loop,
 * *Smooth Subdivision Surfaces Based on Triangles*, 1987, by OpenMesh. Vertices at one place are
 * one; where triangles do not meet by two at an edge, facing the same way, the surface ends, and is
 * smoothed along its end as a curve: no triangle is lost. Those made of one lie together, in its
 * place; meshes are ranges as before, views stay as they are. The same bits on every machine: sums
 * in double, in fixed order, weights rounded to float, so that the last bits of a cosine do not
 * matter (tested up to 10,000 triangles about a vertex). Time grows with the square of that number.
 *
 * Errors and struct_size are as in sobb.h; messages by sobb_last_error(). All functions are
 * thread-safe; a scene is immutable.
 */
#ifndef SOBB_SCENE_H
#define SOBB_SCENE_H

#include "sobb/sobb.h"

#ifdef __cplusplus
extern "C" {
#endif

/* SOBB_SCENE_API is SOBB_API for the importers, whose own build defines SOBB_SCENE_EXPORTS. */
#if !defined(_WIN32) || defined(SOBB_STATIC)
#define SOBB_SCENE_API SOBB_API
#elif defined(SOBB_SCENE_EXPORTS)
#define SOBB_SCENE_API __declspec(dllexport)
#else
#define SOBB_SCENE_API __declspec(dllimport)
#endif

typedef struct sobb_scene sobb_scene; /**< immutable, reference-counted */

/** A pinhole view. */
typedef struct sobb_view {
  float eye[3];
  float target[3];
  float up[3];
  float vfov_degrees; /**< the whole vertical angle */
} sobb_view;

/** A mesh of the file as placed in the scene: a range of the scene's triangles. */
typedef struct sobb_mesh {
  const char* name; /**< UTF-8, owned by the scene; "" if it has none */
  uint64_t first_triangle;
  uint64_t triangle_count;
} sobb_mesh;

/** Options of sobb_scene_load(). Zero in a member means its default. */
typedef struct sobb_scene_options {
  uint32_t struct_size;
  uint32_t reserved;
  /**
   * A JSON file of views: {"STEM": [{"eye": [x,y,z], "target": [x,y,z], "up": [x,y,z],
   * "vfov_degrees": a}, …], …}, STEM the scene file's name without folder and ending. NULL: the
   * file `cameras.json` beside the scene, if there is one; where that cannot be read as one of
   * ours, a note says so, and the scene has its own cameras or the default view.
   */
  const char* views_path;
  /**
   * Bytes that loading may hold at once, the scene's own included; 0 for none, but for JSON and for
   * a primitive's Draco data, which may then take 4 GiB. (Under a limit the latter ask for room by
   * the most that libdraco may need, some 900 bytes per byte and 4 MiB.) A small file may ask for a
   * large scene (a glTF that places one mesh many times), so give a limit with files of unknown
   * origin.
   */
  uint64_t memory_limit;
  /**
   * As in sobb_build_options; called every few milliseconds, so that it can keep a limit of time.
   * (Not while TinyGLTF reads its part of a glTF's JSON, some 50 MB a second, nor while libdraco
   * decodes one primitive, some 5 million triangles a second.)
   */
  int (*progress)(void* user, double fraction);
  void* progress_user;
  /**
   * A point that is subtracted from all positions and views, in double, before they are rounded to
   * float: for large coordinates such as UTM's. A turn about the box's centre comes after it.
   */
  double origin[3];
} sobb_scene_options;
#define SOBB_SCENE_OPTIONS_INIT                                     \
  {                                                                 \
    sizeof(sobb_scene_options), 0, NULL, 0, NULL, NULL, { 0, 0, 0 } \
  }

/** What a scene is; filled by sobb_scene_get_info(). */
typedef struct sobb_scene_info {
  uint32_t struct_size;
  uint32_t default_view; /**< 1 where the file had no view and a default was made, else 0 */
  uint64_t vertex_count;
  uint64_t triangle_count;
  uint64_t degenerate_count; /**< triangles of zero area: two equal corners, or in a line */
  uint64_t mesh_count;
  uint64_t view_count; /**< at least 1 */
  float bounds_min[3]; /**< of the vertices that triangles use */
  float bounds_max[3];
  uint64_t note_count; /**< notes on what was passed over, at most one per cause */
} sobb_scene_info;
#define SOBB_SCENE_INFO_INIT \
  { sizeof(sobb_scene_info), 0, 0, 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0 }

/** Why a part of a scene's source was passed over. Values are never reused. */
typedef enum sobb_note_cause {
  SOBB_NOTE_SHORT_FACE = 1,    /**< faces of fewer than three corners, which have no triangle */
  SOBB_NOTE_UNUSED_VERTEX = 2, /**< vertices not finite or beyond 2^60 that no triangle uses */
  SOBB_NOTE_SURPLUS = 3,       /**< values or bytes behind those that the file declares */
  SOBB_NOTE_UNUSED_ITEM = 4,   /**< malformed items of a document that no triangle needs */
  SOBB_NOTE_EXTENSION = 5,     /**< extensions that were not read and move no triangle */
  SOBB_NOTE_VIEWS = 6          /**< a cameras.json beside the scene that holds no views of sobb */
} sobb_note_cause;

/** What loading passed over for one cause; filled by sobb_scene_get_note(). */
typedef struct sobb_scene_note {
  uint32_t struct_size;
  uint32_t cause;      /**< sobb_note_cause */
  uint64_t count;      /**< items passed over */
  const char* message; /**< the first of them, its place and fault; owned by the scene */
} sobb_scene_note;
#define SOBB_SCENE_NOTE_INIT \
  { sizeof(sobb_scene_note), 0, 0, NULL }

/**
 * Loads a scene.
 * @param source a path, or `builtin:…`, with or without `^TIMES` and `@DEGREES`.
 * @param options NULL for the defaults.
 * @param out the new handle, with one reference, to be given to sobb_scene_release().
 * @return SOBB_ERROR_FILE_OPEN, _FILE_READ; SOBB_ERROR_SCENE_FORMAT (unknown ending or built-in
 *         name), _SCENE_SYNTAX (the message names the line, element or accessor),
 *         _SCENE_UNSUPPORTED (the extension or feature), _SCENE_REFERENCE (the missing or short
 *         file); SOBB_ERROR_INDEX, _NOT_FINITE, _TOO_LARGE, _EMPTY; _OUT_OF_MEMORY, _MEMORY_LIMIT,
 *         _CANCELLED.
 *
 * Views are those of @p options, else of a `cameras.json` beside the file, else the cameras of a
 * glTF, else one default: from the box's centre c with half diagonal h, the eye at
 * c + 2.2 h (0.48, 0.36, 0.8), looking at c, up y, vfov 50 degrees.
 */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_load(const char* source,
                                                          const sobb_scene_options* options,
                                                          sobb_scene** out);

/** Adds a reference. NULL is allowed. Returns its argument. */
SOBB_SCENE_API sobb_scene* sobb_scene_retain(sobb_scene* scene);
/** Drops a reference; the last frees the scene. NULL is allowed. */
SOBB_SCENE_API void sobb_scene_release(sobb_scene* scene);

/** Fills @p info up to its struct_size. */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_get_info(const sobb_scene* scene,
                                                              sobb_scene_info* info);

/**
 * Fills @p note with note @p index (below note_count) up to its struct_size. Notes are in order of
 * their causes.
 */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_get_note(const sobb_scene* scene,
                                                              uint64_t index,
                                                              sobb_scene_note* note);

/** A cause in words for people, such as "faces of fewer than three corners"; never NULL. */
SOBB_SCENE_API const char* sobb_note_cause_name(uint32_t cause);

/** The scene's triangles, ready for sobb_build(); the arrays live as long as the scene. */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_triangles(const sobb_scene* scene,
                                                               sobb_triangles* triangles);

/** Mesh @p index; SOBB_ERROR_INVALID_ARGUMENT beyond mesh_count. Ranges are in order, disjoint. */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_mesh(const sobb_scene* scene, uint64_t index,
                                                          sobb_mesh* mesh);

/** View @p index; SOBB_ERROR_INVALID_ARGUMENT beyond view_count. */
SOBB_NODISCARD SOBB_SCENE_API sobb_status sobb_scene_view(const sobb_scene* scene, uint64_t index,
                                                          sobb_view* view);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SOBB_SCENE_H */
