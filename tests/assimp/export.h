/* SPDX-License-Identifier: MIT */
/* Files in other formats, by assimp's readers and writers. */
#ifndef EXPORT_H
#define EXPORT_H

#include <assimp/cexport.h>
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <stdbool.h>
#include <stdlib.h>

/// The writer of Collada wants as many places and scales as rotations, and that of FBX takes ticks
/// for seconds.
static inline void export_complete(struct aiNodeAnim *node, double seconds) {
    const unsigned count = node->mNumRotationKeys;
    struct aiVectorKey *const places = malloc(count * sizeof *places);
    struct aiVectorKey *const scales = malloc(count * sizeof *scales);
    for (unsigned k = 0; k < count; k++) {
        node->mRotationKeys[k].mTime *= seconds;
        places[k] = node->mPositionKeys[0];
        scales[k] = node->mScalingKeys[0];
        places[k].mTime = scales[k].mTime = node->mRotationKeys[k].mTime;
    }
    node->mPositionKeys = places;
    node->mScalingKeys = scales;
    node->mNumPositionKeys = node->mNumScalingKeys = count;
}

/// Writes a file whose only animation has rotations, and one place and scale for each node.
static inline bool export_scene(const char *from, const char *format, const char *to) {
    const struct aiScene *const scene = aiImportFile(from, 0);
    if (!scene || scene->mNumAnimations != 1) return false;
    struct aiAnimation *const animation = scene->mAnimations[0];
    const unsigned count = animation->mNumChannels;
    struct aiNodeAnim *const kept = malloc(count * sizeof *kept);
    const double seconds = 1 / animation->mTicksPerSecond;
    for (unsigned c = 0; c < count; c++) {
        kept[c] = *animation->mChannels[c];
        export_complete(animation->mChannels[c], seconds);
    }
    animation->mDuration *= seconds;
    animation->mTicksPerSecond = 1;
    const bool good = aiExportScene(scene, format, to, 0) == AI_SUCCESS;
    for (unsigned c = 0; c < count; c++) {
        free(animation->mChannels[c]->mPositionKeys);
        free(animation->mChannels[c]->mScalingKeys);
        *animation->mChannels[c] = kept[c];
    }
    free(kept);
    aiReleaseImport(scene);
    return good;
}

#endif
