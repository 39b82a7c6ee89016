/* Fair surfaces for triangle meshes, for programs in C and in whatever calls C. Arrays in, arrays out; nothing is kept
 * between calls and nothing that is passed in is changed. All functions may be called by several threads at once, each
 * with results of its own. No exception leaves the library.
 *
 * Licence: GPL-3.0-or-later.
 */
#ifndef FAIRING_H
#define FAIRING_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming): C has one room for all names */

#if defined(_WIN32) && defined(FAIRING_BUILDS_LIBRARY)
#define FAIRING_API __declspec(dllexport)
#elif defined(_WIN32)
#define FAIRING_API __declspec(dllimport)
#else
#define FAIRING_API __attribute__((visibility("default")))
#endif

/* The version of this header's interface: it grows where functions or fields come, fairing_interface() of a library
 * that is older is less. */
#define FAIRING_INTERFACE 3

FAIRING_API int fairing_interface(void);
FAIRING_API const char* fairing_version(void); /* of the engine, such as "0.1.0" */

typedef enum fairing_status {
    FAIRING_OK = 0,
    FAIRING_MESH_ERROR = 1,   /* the mesh can't be faired: `code` and `elements` say why and where */
    FAIRING_BAD_ARGUMENT = 2, /* an option or a size is wrong: the message names it */
    FAIRING_CANCELLED = 3,    /* the progress callback said so */
    FAIRING_SOLVER_ERROR = 4, /* the numerics broke down */
    FAIRING_NO_MEMORY = 5,
    FAIRING_INTERNAL_ERROR = 6 /* a bug: report the message */
} fairing_status;

/* What went wrong, in the caller's own memory. */
typedef struct fairing_error {
    char code[32];     /* of FAIRING_MESH_ERROR, such as "NONMANIFOLD_EDGE"; docs/python.md lists them */
    char message[480]; /* UTF-8 */
    int elements[16];  /* the first vertices or triangles that it is about */
    int element_count; /* of `elements` in use */
    int of_triangles;  /* whether these are triangles */
} fairing_error;

/* What to make. Begin with fairing_default_options(). */
typedef struct fairing_options {
    size_t size;                /* sizeof(fairing_options), for libraries of other versions */
    const char* equation;       /* "harmonic", "automatic", "minimal_energy", "soap_film", "least_variation" */
    const char* side;           /* whose slope counts at the boundary: "automatic", "outside", "inside" */
    const char* inner_fairness; /* how vertices sit within it: "uniform", "conformal", … */
    double bulge;               /* of "constant": 1 lifts a flat disc by about a quarter of its radius */
    double tolerance;           /* of the largest move in a step, as a share of the patch's size */
    int stand_in;               /* whether another surface is taken where the equation has none (a warning says so) */
    int threads;                /* 0: one for each core, eight at most; the bits don't depend on it */
} fairing_options;

FAIRING_API fairing_options fairing_default_options(void);

/* Called every 50 ms or so by the thread that called, with the part done (0 … 1) and what is being done. 0 cancels. */
typedef int (*fairing_progress)(double fraction, const char* stage, void* user);

typedef struct fairing_result fairing_result;

/* Replaces the inner vertices of the selected triangles by the fairest surface that continues the triangles around
 * them.
 *
 * points: 3 × point_count coordinates, x y z of each; triangles: 3 × triangle_count vertices, counter-clockwise from
 * outside; selected: triangle_count bytes, not 0 for those to fair. options, progress, error may be NULL. The result
 * belongs to the caller: fairing_free(). */
FAIRING_API fairing_status fairing_fair_faces(const double* points, size_t point_count, const int* triangles,
                                              size_t triangle_count, const unsigned char* selected,
                                              const fairing_options* options, fairing_progress progress, void* user,
                                              fairing_result** result, fairing_error* error);

FAIRING_API void fairing_free(fairing_result* result); /* NULL is allowed */

/* How holes are filled. Begin with fairing_default_fill_options(). */
typedef struct fairing_fill_options {
    size_t size;             /* sizeof(fairing_fill_options) */
    fairing_options surface; /* `side` does not count */
    double spacing;          /* of new edges; 0: as long as the boundary's */
    int bridge;              /* one surface joins all loops */
    int longest;             /* without loops: more edges than that stay open; 0: none do */
    double longest_length;   /* likewise by length */
    int max_vertices;        /* more new ones are refused; 0: what is out of proportion */
} fairing_fill_options;

FAIRING_API fairing_fill_options fairing_default_fill_options(void);

typedef struct fairing_filling fairing_filling;

/* Fills holes, or joins boundary loops, with the fairest surfaces that continue the triangles around them. Each is as
 * if it were the only one; what can't be filled stays open, with its reason.
 *
 * loops: vertices of all loops, one after the other, either way around; loop_sizes: loop_count of them. loop_count 0:
 * all holes, but not the outside of a sheet. FAIRING_MESH_ERROR where none can be filled. The filling belongs to the
 * caller: fairing_free_filling(). */
FAIRING_API fairing_status fairing_fill(const double* points, size_t point_count, const int* triangles,
                                        size_t triangle_count, const int* loops, const size_t* loop_sizes,
                                        size_t loop_count, const fairing_fill_options* options,
                                        fairing_progress progress, void* user, fairing_filling** filling,
                                        fairing_error* error);

/* Fairs the selected triangles and gives them a new mesh: a filling of one "hole", whose loop is the boundary. Of the
 * options `bridge` and `longest` do not count, and `side` does. */
FAIRING_API fairing_status fairing_remesh(const double* points, size_t point_count, const int* triangles,
                                          size_t triangle_count, const unsigned char* selected,
                                          const fairing_fill_options* options, fairing_progress progress, void* user,
                                          fairing_filling** filling, fairing_error* error);

FAIRING_API void fairing_free_filling(fairing_filling* filling); /* NULL is allowed */

/* The new points (x y z of each), and triangles of the old points' numbers and, behind these, the new ones'. */
FAIRING_API const double* fairing_new_points(const fairing_filling* filling, size_t* count);
FAIRING_API const int* fairing_new_triangles(const fairing_filling* filling, size_t* count);

/* One hole: the part of the new points and triangles that is its surface, or why it stays open. */
typedef struct fairing_hole {
    const int* loop; /* vertices around it, the surface on their left; of several loops one after the other */
    size_t loop_size;
    size_t first_point, point_count, first_triangle, triangle_count;
    int converged;
    const char* equation;  /* that holds; NULL where it stays open */
    double worst_join;     /* degrees; a kink is visible from about 12 on */
    const char* left_code; /* why it stays open; NULL where it is filled */
    const char* left_message;
} fairing_hole;

FAIRING_API size_t fairing_hole_count(const fairing_filling* filling);
FAIRING_API fairing_hole fairing_hole_at(const fairing_filling* filling, size_t hole); /* all 0 where there is none */

/* What came out. Pointers live as long as the result; texts are UTF-8. */
FAIRING_API const double* fairing_points(
    const fairing_result* result);                               /* 3 × point_count: all of them, in your order */
FAIRING_API int fairing_converged(const fairing_result* result); /* whether to trust them */
FAIRING_API const char* fairing_equation(const fairing_result* result); /* that holds; another one where one stood in */
FAIRING_API const char* fairing_termination(const fairing_result* result);
FAIRING_API double fairing_worst_boundary_angle(const fairing_result* result); /* degrees off the slope to be met */
FAIRING_API double fairing_worst_join(const fairing_result* result); /* degrees; a kink is visible from about 12 on */

/* Warnings, from 0 on; all three give NULL or 0 where there is no such one. */
FAIRING_API int fairing_warning_count(const fairing_result* result);
FAIRING_API const char* fairing_warning_code(const fairing_result* result, int warning);
FAIRING_API const char* fairing_warning_message(const fairing_result* result, int warning);
/* The vertices or triangles that it is about; their number goes to `count`. */
FAIRING_API const int* fairing_warning_elements(const fairing_result* result, int warning, int* count);

/* Fills `curvatures`, point_count of them, with the mean curvature at each point: −1/R on a sphere of radius R. */
FAIRING_API fairing_status fairing_mean_curvature(const double* points, size_t point_count, const int* triangles,
                                                  size_t triangle_count, double* curvatures, fairing_error* error);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
