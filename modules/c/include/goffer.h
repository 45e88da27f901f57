/* SPDX-License-Identifier: MIT */
#ifndef GOFFER_H
#define GOFFER_H

#include <stddef.h>
#include <stdint.h>

/* goffer for C, and for every language that calls C. One library, libgoffer, has all of it.
 *
 * Bodies are bound from arrays, or loaded from a body file (goffer bake). A job deforms one instance into the
 * caller's memory, a crowd many, from the caller's columns. What C++ headers say of the same things holds
 * here; they are named in brackets.
 *
 * A function that can fail returns null or 0, and says why in *error, unless `error` is null. No exception
 * leaves the library, nothing is printed, and nothing is global. Functions that take a pointer to const may
 * be called from several threads at the same time, if they write to different memory. Objects that
 * goffer_.._free takes belong to the caller; null may be freed. A handle that is null, and an index of what
 * is not there, do no harm: the result is zeros, or nothing is done, except in functions whose argument
 * must validate. Angles are radians, lengths are in the mesh's units. Structs may grow: set one to its
 * defaults, where there is a function for these, or else to 0, before you fill it, and build against the
 * header of the library that you load. */

#ifdef _WIN32
#ifdef GOFFER_BUILDING
#define GOFFER_API __declspec(dllexport)
#else
#define GOFFER_API __declspec(dllimport)
#endif
#else
#define GOFFER_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library, as "0.1.0". */
GOFFER_API const char* goffer_version(void);

/* What an error is about, for programs. These numbers stay as they are; there may be more of them. */
enum {
    GOFFER_ERROR_NONE,
    GOFFER_ERROR_ARGUMENT, /* null, no such value, or inconsistent; a job or crowd that does not validate */
    GOFFER_ERROR_MEMORY,   /* there is not enough; what was half made may be lost */
    GOFFER_ERROR_BIND,     /* the mesh cannot be bound, or not with these numbers in options [fit::Error] */
    GOFFER_ERROR_MISSING,  /* there is no file of that name */
    GOFFER_ERROR_SYSTEM,   /* the file cannot be opened or read */
    GOFFER_ERROR_FILE,     /* no body file, or one that is damaged */
    GOFFER_ERROR_VERSION,  /* a body file of an unknown version or of the other byte order: bake it again */
    GOFFER_ERROR_OTHER     /* nothing of these: the text says what */
};

/* What went wrong; of a call that did not fail, no text and GOFFER_ERROR_NONE. */
typedef struct goffer_error {
    char text[512]; /* one line, for people: may change from version to version */
    int code;       /* the error, one of the numbers above */
} goffer_error;

/* Characters, not null-terminated. */
typedef struct goffer_string {
    const char* data;
    size_t size;
} goffer_string;

/* Instruction sets. [goffer/engine/isa.hpp] */
enum {
    GOFFER_ISA_AUTOMATIC,
    GOFFER_ISA_SCALAR,
    GOFFER_ISA_SSE42,
    GOFFER_ISA_AVX2,
    GOFFER_ISA_AVX512,
    GOFFER_ISA_NEON
};
/* 1 if the library has kernels for `isa` and this machine can run them. */
GOFFER_API int goffer_isa_runs_here(int isa);

/* The most regions that a body can have. */
#define GOFFER_MAX_REGIONS 32

typedef struct goffer_pose {
    float angle;     /* of the region's arc; beyond the region's largest it is clamped */
    float direction; /* about the axis, from e1 toward e2 */
} goffer_pose;

typedef struct goffer_bounds {
    float low[3], high[3];
} goffer_bounds;

/* ---- Bodies [goffer/bend/body.hpp] ---- */

typedef struct goffer_body goffer_body;

/* A mesh in the caller's memory. [fit::Geometry] */
typedef struct goffer_mesh {
    const float* positions; /* 3 floats per vertex */
    const float* normals;   /* null, or 3 floats per vertex */
    const float* tangents;  /* null, or 4 floats per vertex */
    size_t vertex_count;
    const uint32_t* triangles; /* 3 vertices each */
    size_t triangle_count;
    const float* wrinkle_mask; /* null, or how much of its wrinkle each vertex follows, 0 to 1 */
} goffer_mesh;

enum { GOFFER_PROFILE_EVEN, GOFFER_PROFILE_DAMPED, GOFFER_PROFILE_SMOOTH }; /* profiles */
enum { GOFFER_AMPLITUDE_NONE, GOFFER_AMPLITUDE_PAPER, GOFFER_AMPLITUDE_AREA, GOFFER_AMPLITUDE_MESH };

/* How to bind. goffer_bind_defaults() has what suits a mesh that nobody has looked at. [fit::BindOptions] */
typedef struct goffer_bind_options {
    int profile, amplitude;
    double roundness;                   /* of GOFFER_PROFILE_EVEN, 0 to 0.5 */
    int folds;                          /* of each region, or of a chain; negative: what suits it */
    double fold_length;                 /* in radii; 0: the profile's own */
    int one_radius;                     /* not 0: the base is a cylinder, whatever the body's shape */
    int straight;                       /* not 0: the rest shape is taken for straight */
    double onset;                       /* negative: what suits the body */
    double wrinkle_first, wrinkle_last; /* what may wrinkle, as shares of the length; defaults: 0, 1 */
    const double* axis;                 /* null, or 3 numbers from base to tip */
    const double* shares;               /* null, or what each region is of the length; adds up to 1 */
    size_t region_count;                /* of shares */
    int folds_apart;                    /* not 0: folds end where regions meet, instead of running on */
    /* Of a chain that the body is bent along at rest, 2 to GOFFER_MAX_REGIONS, each of which is a region;
     * negative: as many as follow it, where one does not; 0 or 1: no chain. A chain goes with neither shares
     * nor straight. */
    int arcs;
} goffer_bind_options;

GOFFER_API goffer_bind_options goffer_bind_defaults(void);

/* Fits the base cylinder and binds the mesh to it; `options` may be null. Offline: it allocates, and takes
 * longer than a frame. [fit::bind] */
GOFFER_API goffer_body* goffer_body_bind(const goffer_mesh* mesh, const goffer_bind_options* options,
                                         goffer_error* error);
/* Binds a coarser mesh of the same model, or a layer of clothes, to the base, regions and wrinkles of `rig`,
 * which was bound here: one array of poses serves both, and vertices at the same place at rest go to the same
 * place. Of what goffer_body_folds() tells of it, the capacity is the level's, and the rest the rig's. `rig`
 * is not needed afterward. [fit::bind_level] */
GOFFER_API goffer_body* goffer_body_bind_level(const goffer_mesh* level, const goffer_body* rig,
                                               goffer_error* error);
/* Not for the bodies of a file. */
GOFFER_API void goffer_body_free(goffer_body* body);

/* Zeros for null, and where there is no such region. [bend::Body] */
GOFFER_API size_t goffer_body_vertex_count(const goffer_body* body);
GOFFER_API size_t goffer_body_region_count(const goffer_body* body);
GOFFER_API int goffer_body_has_tangents(const goffer_body* body);
GOFFER_API double goffer_body_length(const goffer_body* body);
GOFFER_API double goffer_body_radius(const goffer_body* body);
GOFFER_API float goffer_body_max_angle(const goffer_body* body, size_t region);
GOFFER_API goffer_pose goffer_body_rest_pose(const goffer_body* body, size_t region);
/* Which vertex of the bound mesh each vertex of the body is; null where the order is the mesh's, and for
 * bodies of a file, which have goffer_file_mesh().source. */
GOFFER_API const uint32_t* goffer_body_order(const goffer_body* body);

/* The base cylinder that a mesh was bound to, in the mesh's space. [fit::Cylinder] */
typedef struct goffer_base {
    double origin[3];      /* center of the base end */
    double axis[3];        /* e3, of unit length: from base to tip, at the base end of an arc */
    double zero[3];        /* e1, of unit length: direction 0 */
    double length, radius; /* the length is that of an arc's outer line */
    double rest_angle, rest_direction;
    double residual; /* how far the mesh is from the cylinder, rms, in radii */
} goffer_base;

/* Why a region has fewer folds than were asked for or, where no number was, than suit it
 * [fit::FoldShortage]: it has at least half of them; the mesh's rows of vertices are too far apart; the
 * wrinkle range leaves too little of it; it is too long. */
enum { GOFFER_SHORTAGE_NONE, GOFFER_SHORTAGE_ROWS, GOFFER_SHORTAGE_RANGE, GOFFER_SHORTAGE_LENGTH };

/* How many folds a region has, over its whole length with GOFFER_PROFILE_EVEN, else over half of it.
 * [fit::RegionBinding] */
typedef struct goffer_folds {
    int made;     /* 0: it bends without wrinkles */
    int capacity; /* the most that the mesh has vertices for */
    int suitable; /* as many as a mesh that is fine enough gets where nobody asks for a number */
    int shortage; /* one of GOFFER_SHORTAGE_ */
} goffer_folds;

/* What was found at bind; zeros for the bodies of a file, and where there is no such region. */
GOFFER_API goffer_base goffer_body_base(const goffer_body* body);
GOFFER_API goffer_folds goffer_body_folds(const goffer_body* body, size_t region);

/* ---- Body files [goffer/bend/body_file.hpp] ---- */

typedef struct goffer_file goffer_file;

enum { GOFFER_VERIFY_EVERYTHING, GOFFER_VERIFY_CHECKSUM, GOFFER_VERIFY_LAYOUT };

/* Loads a body file from memory. With `copy` the bytes are not needed afterward; without it they must begin
 * at a multiple of 64 bytes, as a mapped file's do, and stay as they are until goffer_file_free(). */
GOFFER_API goffer_file* goffer_file_load(const void* bytes, size_t size, int verify, int copy,
                                         goffer_error* error);
/* Reads the file of that name. */
GOFFER_API goffer_file* goffer_file_open(const char* name, int verify, goffer_error* error);
/* Frees its bodies too. */
GOFFER_API void goffer_file_free(goffer_file* file);

/* What is drawn of a level. `uvs` and `source` may be null. The memory is the file's. */
typedef struct goffer_file_draw {
    const uint32_t* triangles; /* 3 vertices of the body each, counterclockwise from outside */
    size_t triangle_count;
    const float* uvs; /* 2 floats per vertex, v up */
    /* Which vertex of the model each vertex is; not checked against any model. */
    const uint32_t* source;
    size_t part_count;
    goffer_bounds rest_bounds; /* of all vertices at rest, as the file has it: not checked */
} goffer_file_draw;

typedef struct goffer_part {
    goffer_string name;
    uint32_t first_triangle, triangle_count;
    int32_t material; /* -1: none */
} goffer_part;

typedef struct goffer_material {
    goffer_string name;
    float base_color[4]; /* linear RGBA */
} goffer_material;

/* Levels count from 0, the finest. */
GOFFER_API size_t goffer_file_level_count(const goffer_file* file);
GOFFER_API const goffer_body* goffer_file_body(const goffer_file* file, size_t level);
GOFFER_API goffer_file_draw goffer_file_mesh(const goffer_file* file, size_t level);
GOFFER_API goffer_part goffer_file_part(const goffer_file* file, size_t level, size_t part);
GOFFER_API size_t goffer_file_material_count(const goffer_file* file);
GOFFER_API goffer_material goffer_file_material(const goffer_file* file, size_t material);
GOFFER_API size_t goffer_file_socket_count(const goffer_file* file);
GOFFER_API goffer_string goffer_file_socket_name(const goffer_file* file, size_t socket);
GOFFER_API goffer_string goffer_file_notes(const goffer_file* file);

/* ---- One instance [goffer/bend/job.hpp] ---- */

/* Component c of vertex i is written `stride` * i bytes after component[c]. All null: not wanted. The fourth
 * component is a tangent's w. */
typedef struct goffer_stream {
    float* component[4];
    size_t stride; /* a multiple of 4, not 0; 4 for planes */
    size_t count;  /* vertices that the memory holds */
} goffer_stream;

/* 12 bytes a vertex, as goffer/bend/packed.hpp says. */
typedef struct goffer_packed_stream {
    void* first;
    size_t stride; /* a multiple of 4, 12 or more */
    size_t count;
} goffer_packed_stream;

typedef struct goffer_job {
    const goffer_body* body;
    const goffer_pose* poses; /* one for each region */
    size_t pose_count;
    float wrinkle_weight;   /* 0 to 1; a job of zeros has no wrinkles */
    const float* transform; /* null, or 12 floats: four columns of 3, as glm::mat4x3 */
    goffer_stream positions, normals, tangents;
    goffer_packed_stream packed;
    goffer_stream previous_positions;
    const goffer_pose* previous_poses; /* as many as poses */
    const float* previous_transform;
    goffer_bounds* bounds; /* null, or set by a run */
    int isa;               /* one that runs here */
} goffer_job;

/* A job that wants nothing yet, with full wrinkles. */
GOFFER_API goffer_job goffer_job_defaults(void);

typedef struct goffer_job_result {
    int clamped; /* all poses were finite, and an angle was beyond the largest and was clamped to it */
    int at_rest; /* a pose was not finite, and all were taken as at rest */
} goffer_job_result;

/* 1 if the job may run. A job that validated once may run again with any numbers in poses, weight and
 * transforms. */
GOFFER_API int goffer_job_validate(const goffer_job* job, goffer_error* error);
/* The job must validate. Allocates nothing. */
GOFFER_API goffer_job_result goffer_job_run(const goffer_job* job);
/* Only the vertices [first, last), for threads of the caller's: ranges that cover all vertices leave the bits
 * of goffer_job_run(), in any order, also at the same time. The one that has vertex 0 sets `bounds`. The job
 * must validate; for a range that is not within the body's vertices nothing is done. */
GOFFER_API goffer_job_result goffer_job_run_range(const goffer_job* job, size_t first, size_t last);
/* The same as goffer_job_run() on all threads, with oneTBB if the library has it: for one large body. */
GOFFER_API goffer_job_result goffer_job_run_parallel(const goffer_job* job);
/* From poses, transform and wrinkle weight; streams are not looked at. job->body and poses must be given. */
GOFFER_API goffer_bounds goffer_job_bounds(const goffer_job* job);

typedef struct goffer_capsule {
    float from[3], to[3], radius;
} goffer_capsule;

/* Writes `pieces` >= 1 capsules for each region. The job has a pose for each region; its streams are not
 * looked at. */
GOFFER_API void goffer_job_capsules(const goffer_job* job, size_t pieces, goffer_capsule* result);

/* ---- Crowds [goffer/bend/crowd.hpp] ---- */

/* `count` elements, `stride` bytes apart, the first one `offset` bytes after `data`. `data` null: not given.
 * In pages of a power of two, `data` is an array of the pages' addresses, and page_size how many elements
 * each holds, at most 2^32; 0: no pages. A stride of 0: all elements are the same one; `count` is still the
 * number of elements: of instances or, with indices, more than the largest index. */
typedef struct goffer_column {
    const void* data;
    size_t count;
    uint32_t stride, offset;
    size_t page_size;
} goffer_column;

enum { GOFFER_COLUMNS3, GOFFER_COLUMNS4, GOFFER_ROWS4 }; /* TransformColumn::MatrixLayout */

typedef struct goffer_batch {
    const goffer_body* body;
    size_t count;            /* instances */
    const uint32_t* indices; /* null, or `count` of them: the element that each one reads */
    /* goffer_pose; those of further regions after the first one's: the stride has room for as many as the
     * body has regions. */
    goffer_column poses;
    goffer_column transforms;      /* floats, as transform_layout says; not given: the identity */
    int transform_layout;          /* of previous_transforms too */
    goffer_column wrinkle_weights; /* float; not given: 1 */
    /* With previous_positions: the poses must be given then; without transforms the identity is taken. */
    goffer_column previous_poses, previous_transforms;
    goffer_column visible, changed, update_intervals; /* uint8_t; not given: 1 */
    goffer_stream positions, normals, tangents;
    goffer_packed_stream packed;
    goffer_stream previous_positions;
    goffer_bounds* bounds;        /* null, or `count` of them, set by a run for those that it does not skip */
    goffer_column vertex_offsets; /* uint32_t; not given: instance i begins at i * vertex_step */
    size_t vertex_step;
    int scratch_gaps;
} goffer_batch;

typedef struct goffer_crowd_result {
    size_t deformed; /* instances that were not skipped */
    size_t clamped;  /* those among them with finite poses and an angle beyond the largest */
    size_t at_rest;  /* those among them with a pose that was not finite */
} goffer_crowd_result;

typedef struct goffer_crowd goffer_crowd;

/* A crowd of `batch_count` batches that are not set; it validates once each of them is. */
GOFFER_API goffer_crowd* goffer_crowd_create(size_t batch_count, goffer_error* error);
GOFFER_API void goffer_crowd_free(goffer_crowd* crowd);
/* Sets batch `index`. What the batch points to is read when the crowd runs, so that it is to be set again
 * only where an address or a count changes. Allocates nothing unless it returns an error. */
GOFFER_API int goffer_crowd_set(goffer_crowd* crowd, size_t index, const goffer_batch* batch,
                                goffer_error* error);
/* The number of the frame, by which update_intervals count. */
GOFFER_API void goffer_crowd_set_frame(goffer_crowd* crowd, uint32_t frame);
/* Whether results go past the cache. Any other number means automatic. [bend::Stores] */
enum { GOFFER_STORES_AUTOMATIC, GOFFER_STORES_CACHED, GOFFER_STORES_NON_TEMPORAL };
GOFFER_API void goffer_crowd_set_stores(goffer_crowd* crowd, int stores);
/* The crowd does not validate if `isa` does not run here. */
GOFFER_API void goffer_crowd_set_isa(goffer_crowd* crowd, int isa);
/* 1 if the crowd may run. A crowd that validated once may run again with any numbers in its columns, but
 * those of indices and vertex offsets. */
GOFFER_API int goffer_crowd_validate(const goffer_crowd* crowd, goffer_error* error);
/* These three deform all batches: on the calling thread, on all threads, or piece by piece on threads of the
 * caller's. The crowd must validate. The bits are the same. For a `piece` that is not below `pieces` nothing
 * is done. */
GOFFER_API goffer_crowd_result goffer_crowd_run(const goffer_crowd* crowd);
GOFFER_API goffer_crowd_result goffer_crowd_run_parallel(const goffer_crowd* crowd);
GOFFER_API goffer_crowd_result goffer_crowd_run_piece(const goffer_crowd* crowd, size_t piece, size_t pieces);
/* The bounds of each instance of a batch, from its poses, transforms and wrinkle weights; `result` holds as
 * many. The batch has a body, and columns as for a crowd that validates; its streams are not looked at. */
GOFFER_API void goffer_crowd_bounds(const goffer_crowd* crowd, size_t index, goffer_bounds* result);

/* ---- Shaders [modules/gpu/README.md, goffer/gpu/vertices.hpp, goffer/bend/kernel_input.hpp] ---- */

/* Where the attributes of a vertex lie in its record, bytes; SIZE_MAX: the body does not have it. */
typedef struct goffer_vertex_layout {
    size_t stride, column, wrinkle, normal, shape, tangent, joint;
} goffer_vertex_layout;

GOFFER_API goffer_vertex_layout goffer_body_vertex_layout(const goffer_body* body);
/* Writes the records of all vertices: stride bytes each. */
GOFFER_API void goffer_body_write_vertices(const goffer_body* body, void* result);

/* Floats that a shader reads of each region of each instance. */
#define GOFFER_COEFFICIENTS 68
/* Writes them for a batch as goffer_crowd_bounds() takes it, whatever its masks say: instance after instance,
 * those of its regions in order. `result` is aligned to 16 bytes. */
GOFFER_API void goffer_crowd_set_up(const goffer_crowd* crowd, size_t index, float* result);
/* The same at the previous poses, which must be given, and transforms (not given: the identity). */
GOFFER_API void goffer_crowd_set_up_previous(const goffer_crowd* crowd, size_t index, float* result);
/* The text of goffer/gpu/deform.glsl; a 0 follows it. */
GOFFER_API goffer_string goffer_deform_glsl(void);

/* ---- Sockets [goffer/bend/sockets.hpp] ---- */

typedef struct goffer_sockets goffer_sockets;

typedef struct goffer_socket_frame {
    float axes[9]; /* columns: along the surface, across, outward */
    float position[3];
} goffer_socket_frame;

/* All sockets of a file; null, with GOFFER_ERROR_ARGUMENT, where it has none. */
GOFFER_API goffer_sockets* goffer_file_sockets(const goffer_file* file, goffer_error* error);
/* Sockets of a bound body, at the places of `mesh`, which is the one that it was bound from, that are nearest
 * to `count` points of 3 floats. */
GOFFER_API goffer_sockets* goffer_body_sockets(const goffer_body* body, const goffer_mesh* mesh,
                                               const float* points, size_t count, goffer_error* error);
GOFFER_API void goffer_sockets_free(goffer_sockets* sockets);
GOFFER_API size_t goffer_sockets_count(const goffer_sockets* sockets);
/* Writes the frame of each socket at the job's poses, transform and weight. Allocates nothing. */
GOFFER_API void goffer_sockets_frames(const goffer_sockets* sockets, const goffer_job* job,
                                      goffer_socket_frame* result);

#ifdef __cplusplus
}
#endif

#endif
