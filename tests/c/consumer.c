/* The C library by its header alone: what it computes, and what it says of bad input. */
#include <fairing.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 32, ROWS = 16, POINTS = COLUMNS * (ROWS + 1), TRIANGLES = 2 * COLUMNS * ROWS };

static double points[3 * POINTS];
static int triangles[3 * TRIANGLES];
static unsigned char selected[TRIANGLES];
static int failures = 0;

#define CHECK(holds)                                                   \
    do {                                                               \
        if (!(holds)) {                                                \
            printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #holds); \
            ++failures;                                                \
        }                                                              \
    } while (0)

/* A tube of radius 1 with a dent in its middle, which is selected. */
static void make_tube(void) {
    const double pi = acos(-1.0);
    for (int v = 0; v < POINTS; ++v) {
        const double angle = 2 * pi * (v % COLUMNS) / COLUMNS, height = 2.0 * (v / COLUMNS) / ROWS - 1;
        const double inner = 1 - pow(height / 0.375, 2), radius = inner > 0 ? 1 - 0.1 * inner * inner : 1;
        points[3 * v] = radius * cos(angle);
        points[3 * v + 1] = radius * sin(angle);
        points[3 * v + 2] = height;
    }
    for (int quad = 0; quad < COLUMNS * ROWS; ++quad) {
        const int row = quad / COLUMNS, a = quad, b = row * COLUMNS + (quad + 1) % COLUMNS;
        const int corners[6] = {a, b, b + COLUMNS, a, b + COLUMNS, a + COLUMNS};
        memcpy(&triangles[6 * quad], corners, sizeof corners);
        selected[2 * quad] = selected[2 * quad + 1] = row >= 5 && row < 11;
    }
}

static fairing_status fair(const fairing_options* options, fairing_progress progress, void* user,
                           fairing_result** result, fairing_error* error) {
    return fairing_fair_faces(points, POINTS, triangles, TRIANGLES, selected, options, progress, user, result, error);
}

static double off_the_tube(const double* at) {
    double worst = 0;
    for (int v = 0; v < POINTS; ++v) {
        const double distance = fabs(hypot(at[3 * v], at[3 * v + 1]) - 1);
        if (!(distance <= worst)) worst = distance;
    }
    return worst;
}

static int count_calls(double fraction, const char* stage, void* user) {
    CHECK(fraction >= 0 && fraction <= 1 && strlen(stage) > 0);
    ++*(int*)user;
    return 1;
}

static int cancel(double fraction, const char* stage, void* user) {
    (void)fraction, (void)stage, (void)user;
    return 0;
}

static void test_the_tube_comes_back(void) {
    static double before[3 * POINTS];
    memcpy(before, points, sizeof points);
    fairing_result* result = NULL;
    fairing_error error;
    int calls = 0;
    CHECK(fair(NULL, count_calls, &calls, &result, &error) == FAIRING_OK);
    CHECK(memcmp(before, points, sizeof points) == 0);
    CHECK(off_the_tube(points) > 0.05);
    CHECK(result && off_the_tube(fairing_points(result)) < 1e-4);
    CHECK(fairing_converged(result) && strcmp(fairing_equation(result), "harmonic") == 0);
    CHECK(strcmp(fairing_termination(result), "converged") == 0);
    CHECK(fairing_worst_boundary_angle(result) < 1 && fairing_worst_join(result) < 12);
    CHECK(fairing_warning_count(result) == 0 && fairing_warning_code(result, 0) == NULL);
    CHECK(calls > 0 && error.message[0] == 0);
    for (int v = 0; v < 5 * COLUMNS; ++v) CHECK(fairing_points(result)[3 * v] == points[3 * v]);
    fairing_free(result);
}

static void test_options(void) {
    fairing_options options = fairing_default_options();
    fairing_result* result = NULL;
    options.equation = "soap_film";
    CHECK(fair(&options, NULL, NULL, &result, NULL) == FAIRING_OK);
    CHECK(strcmp(fairing_equation(result), "soap_film") == 0);
    CHECK(off_the_tube(fairing_points(result)) > 0.01); /* a soap film has a waist */
    fairing_free(result);
}

static void test_warnings(void) {
    fairing_result* result = NULL;
    int count = 0;
    memset(selected, 0, sizeof selected);
    memset(selected, 1, 2 * COLUMNS * 6); /* up to the open border */
    CHECK(fair(NULL, NULL, NULL, &result, NULL) == FAIRING_OK);
    CHECK(fairing_warning_count(result) > 0);
    CHECK(strcmp(fairing_warning_code(result, 0), "OPEN_BORDER_IN_SELECTION") == 0);
    CHECK(strlen(fairing_warning_message(result, 0)) > 10);
    CHECK(fairing_warning_elements(result, 0, &count) && count == COLUMNS);
    CHECK(fairing_warning_elements(result, 99, &count) == NULL && count == 0);
    fairing_free(result);
    make_tube();
}

static void refused(const fairing_options* options, fairing_progress progress, fairing_status wanted,
                    const char* word) {
    fairing_result* result = (fairing_result*)&failures;
    fairing_error error;
    const fairing_status status = fair(options, progress, NULL, &result, &error);
    CHECK(status == wanted);
    CHECK(strstr(error.message, word) || strcmp(error.code, word) == 0);
    CHECK(result == NULL || result == (fairing_result*)&failures);
}

static void test_bad_input(void) {
    fairing_options options = fairing_default_options();
    fairing_error error;
    refused(NULL, cancel, FAIRING_CANCELLED, "cancelled");
    options.equation = "soap";
    refused(&options, NULL, FAIRING_BAD_ARGUMENT, "soap");
    options = fairing_default_options();
    options.side = "left";
    refused(&options, NULL, FAIRING_BAD_ARGUMENT, "side");
    options = fairing_default_options();
    options.size = 4;
    refused(&options, NULL, FAIRING_BAD_ARGUMENT, "size");
    CHECK(fair(NULL, NULL, NULL, NULL, &error) == FAIRING_BAD_ARGUMENT);
    triangles[3 * 500] = -7;
    refused(NULL, NULL, FAIRING_MESH_ERROR, "INDEX_RANGE");
    CHECK(fair(NULL, NULL, NULL, (fairing_result*[]){NULL}, &error) == FAIRING_MESH_ERROR);
    CHECK(error.element_count == 1 && error.elements[0] == 500 && error.of_triangles);
    make_tube();
    points[3 * 8 * COLUMNS] = NAN;
    refused(NULL, NULL, FAIRING_MESH_ERROR, "NONFINITE");
    make_tube();
    memset(selected, 0, sizeof selected);
    refused(NULL, NULL, FAIRING_BAD_ARGUMENT, "selected");
    make_tube();
    fairing_free(NULL);
}

/* The tube without its middle: bridged, and each of its four borders filled by itself. */
static void test_fill(void) {
    static int around[3 * TRIANGLES];
    int loops[2 * COLUMNS];
    const size_t sizes[2] = {COLUMNS, COLUMNS};
    size_t count = 0, points_made = 0, triangles_made = 0;
    for (int t = 0; t < TRIANGLES; ++t)
        if (!selected[t]) memcpy(&around[3 * count++], &triangles[3 * t], 3 * sizeof(int));
    for (int k = 0; k < COLUMNS; ++k) loops[k] = 5 * COLUMNS + k, loops[COLUMNS + k] = 11 * COLUMNS + k;
    fairing_fill_options options = fairing_default_fill_options();
    fairing_filling* filling = NULL;
    fairing_error error;
    options.bridge = 1;
    CHECK(fairing_fill(points, POINTS, around, count, loops, sizes, 2, &options, NULL, NULL, &filling, &error) ==
          FAIRING_OK);
    const double* made = fairing_new_points(filling, &points_made);
    CHECK(points_made > 50 && fairing_new_triangles(filling, &triangles_made) && triangles_made > points_made);
    for (size_t v = 0; v < points_made; ++v) CHECK(fabs(hypot(made[3 * v], made[3 * v + 1]) - 1) < 1e-3);
    CHECK(fairing_hole_count(filling) == 1 && fairing_hole_at(filling, 0).loop_size == 2 * COLUMNS);
    CHECK(fairing_hole_at(filling, 0).converged && fairing_hole_at(filling, 0).left_code == NULL);
    CHECK(fairing_hole_at(filling, 1).loop == NULL);
    fairing_free_filling(filling);
    CHECK(fairing_fill(points, POINTS, around, count, NULL, NULL, 0, NULL, NULL, NULL, &filling, &error) == FAIRING_OK);
    CHECK(fairing_hole_count(filling) == 4);
    for (size_t k = 0; k < 4; ++k) CHECK(fairing_hole_at(filling, k).equation != NULL);
    fairing_free_filling(filling);
    CHECK(fairing_fill(points, POINTS, around, count, NULL, NULL, 0, NULL, cancel, NULL, &filling, &error) ==
          FAIRING_CANCELLED);
    options.longest = 3;
    CHECK(fairing_fill(points, POINTS, around, count, NULL, NULL, 0, &options, NULL, NULL, &filling, &error) ==
          FAIRING_MESH_ERROR);
    CHECK(strcmp(error.code, "NO_BOUNDARY") == 0);
    options.size = 4;
    CHECK(fairing_fill(points, POINTS, around, count, NULL, NULL, 0, &options, NULL, NULL, &filling, &error) ==
          FAIRING_BAD_ARGUMENT);
    fairing_free_filling(NULL);
}

int main(void) {
    CHECK(fairing_interface() == FAIRING_INTERFACE);
    CHECK(strlen(fairing_version()) >= 5);
    make_tube();
    test_the_tube_comes_back();
    test_options();
    test_warnings();
    test_bad_input();
    test_fill();
    printf("%s\n", failures ? "failed" : "passed");
    return failures != 0;
}
