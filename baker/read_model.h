/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_READ_MODEL_H
#define LIMNI_READ_MODEL_H

#include "model.h"
#include "scene.h"

/// Makes sources of the meshes in the scene of a model, and characters of what moves them
/// (docs/meshes.md). Frees the large arrays of the model, but for the bytes of images.
///
/// name  of the file, for meshes without one
limn_bake_status limni_read_model(limni_context *context, limni_model *model, const char *name,
                                  limni_scene *scene);

#endif
