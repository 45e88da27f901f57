/* SPDX-License-Identifier: MIT */

/* A crowd from C: loads a body file, deforms a hundred instances of its body from one array of structs into
 * one vertex buffer, and prints a number that stands for all bits of it. crowd.py does the same.
 *
 *     goffer bake worm.glb -o worm.goffer && goffer_c_sample worm.goffer */

#include <goffer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { instances = 100 };

/* What an engine keeps for an instance. */
typedef struct Worm {
    goffer_pose poses[GOFFER_MAX_REGIONS];
    float model[12]; /* four columns of 3 */
} Worm;

typedef struct Vertex {
    float position[3], normal[3];
} Vertex;

/* Each worm bends its own way, and stands on its own spot. */
static void pose_worms(Worm* worms, const goffer_body* body) {
    const double step = 1.5 * goffer_body_length(body);
    const size_t regions = goffer_body_region_count(body);
    for (size_t i = 0; i < instances; ++i) {
        Worm* worm = &worms[i];
        memset(worm, 0, sizeof *worm);
        for (size_t r = 0; r < regions; ++r) {
            const double limit = (double)goffer_body_max_angle(body, r);
            worm->poses[r].angle = (float)(limit * sin(2.4 * (double)i));
            worm->poses[r].direction = (float)(0.5 * (double)i);
        }
        worm->model[0] = worm->model[4] = worm->model[8] = 1;
        worm->model[9] = (float)(step * (double)(i % 10));
        worm->model[11] = (float)(step * (double)(i / 10));
    }
}

static goffer_stream stream_of(float* first, size_t vertices) {
    goffer_stream stream = {{first, first + 1, first + 2, NULL}, sizeof(Vertex), 0};
    stream.count = vertices;
    return stream;
}

/* The sum of all 32-bit words, each times its place. */
static uint64_t sum_of(const void* bytes, size_t size) {
    uint64_t sum = 0;
    for (size_t i = 0; i < size / 4; ++i) {
        uint32_t word;
        memcpy(&word, (const char*)bytes + 4 * i, sizeof word);
        sum += (uint64_t)word * (i + 1);
    }
    return sum;
}

static int run(const goffer_body* body, goffer_error* error) {
    const size_t count = goffer_body_vertex_count(body), vertices = instances * count;
    Worm* worms = malloc(instances * sizeof *worms);
    Vertex* buffer = malloc(vertices * sizeof *buffer);
    goffer_crowd* crowd = goffer_crowd_create(1, error);
    int good = worms != NULL && buffer != NULL && crowd != NULL;
    if (good) {
        goffer_batch batch;
        memset(&batch, 0, sizeof batch);
        pose_worms(worms, body);
        batch.body = body;
        batch.count = instances;
        batch.poses.data = batch.transforms.data = worms;
        batch.poses.count = batch.transforms.count = instances;
        batch.poses.stride = batch.transforms.stride = sizeof *worms;
        batch.transforms.offset = (uint32_t)offsetof(Worm, model);
        batch.positions = stream_of(buffer[0].position, vertices);
        batch.normals = stream_of(buffer[0].normal, vertices);
        batch.vertex_step = count;
        good = goffer_crowd_set(crowd, 0, &batch, error) && goffer_crowd_validate(crowd, error);
    }
    if (good) { /* in every frame: */
        const goffer_crowd_result result = goffer_crowd_run_parallel(crowd);
        printf("%zu instances of %zu vertices: %016llx\n", result.deformed, count,
               (unsigned long long)sum_of(buffer, vertices * sizeof *buffer));
    }
    goffer_crowd_free(crowd);
    free(buffer);
    free(worms);
    return good;
}

int main(int argc, char** argv) {
    goffer_error error = {"not enough memory", GOFFER_ERROR_MEMORY};
    goffer_file* file = NULL;
    int good = 0;
    if (argc != 2) {
        fprintf(stderr, "usage: goffer_c_sample FILE.goffer\n");
        return 2;
    }
    file = goffer_file_open(argv[1], GOFFER_VERIFY_EVERYTHING, &error);
    if (file != NULL) good = run(goffer_file_body(file, 0), &error);
    goffer_file_free(file);
    if (!good) fprintf(stderr, "goffer_c_sample: %s: %s\n", argv[1], error.text);
    return good ? 0 : 1;
}
