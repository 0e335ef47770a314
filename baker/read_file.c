/* SPDX-License-Identifier: MIT */
#define _FILE_OFFSET_BITS 64

#include "scene.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef limn_bake_status read_text_fn(limni_context *context, const char *text, size_t size,
                                      limni_source *source);
typedef limn_bake_status read_scene_fn(limni_context *context, const char *path, const char *name,
                                       const char *bytes, size_t size, limni_scene *scene);

static const char *find_file_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/// The last dot of the name with what follows it, or the end of the name. A dot at the start hides
/// a file and begins no extension.
static const char *find_extension(const char *file_name) {
    const char *dot = strrchr(file_name, '.');
    return dot && dot != file_name ? dot : file_name + strlen(file_name);
}

/// Without tolower(), which asks the locale.
static bool equal_without_case(const char *text, const char *lower) {
    for (; *text && *lower; text++, lower++) {
        const char c = *text;
        const char folded = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
        if (folded != *lower) return false;
    }
    return *text == *lower;
}

bool limni_has_extension(const char *path, const char *lower) {
    return equal_without_case(find_extension(find_file_name(path)), lower);
}

/// Of one mesh, or of a scene: the other is NULL.
typedef struct format {
    const char *extension;
    read_text_fn *read_mesh;
    read_scene_fn *read_scene;
} format;

static const format *find_format(const char *path) {
    static const format formats[] = {
        {".obj", limni_read_obj, NULL},    {".off", limni_read_off, NULL},
        {".ply", limni_read_ply, NULL},    {".gltf", NULL, limni_read_gltf},
        {".glb", NULL, limni_read_gltf},   {".fbx", NULL, limni_read_assimp},
        {".dae", NULL, limni_read_assimp},
    };
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        if (limni_has_extension(path, formats[f].extension)) return &formats[f];
    }
    return NULL;
}

static char *copy_text(limni_context *context, const char *text, size_t size) {
    char *copy = limni_allocate(context, size + 1, 1);
    if (!copy) return NULL;
    memcpy(copy, text, size);
    copy[size] = '\0';
    return copy;
}

/// Path and name outlive the caller's path: later steps name the file in their errors.
static limn_bake_status name_source(limni_context *context, const char *path,
                                    limni_source *source) {
    const char *file_name = find_file_name(path);
    const size_t stem_size = (size_t)(find_extension(file_name) - file_name);
    source->path = copy_text(context, path, strlen(path));
    source->name = copy_text(context, file_name, stem_size);
    return source->path && source->name ? LIMN_BAKE_OK : LIMN_BAKE_MEMORY;
}

static limn_bake_status find_size(limni_context *context, const char *path, size_t *size) {
    struct stat information;
    if (stat(path, &information) != 0) {
        return limni_fail(context, LIMN_BAKE_IO, "%s: cannot be read: %s", path, strerror(errno));
    }
    if (S_ISDIR(information.st_mode)) {
        return limni_fail(context, LIMN_BAKE_IO, "%s: is a folder, not a file", path);
    }
    if (!S_ISREG(information.st_mode)) {
        return limni_fail(context, LIMN_BAKE_IO, "%s: is not a regular file", path);
    }
    if (information.st_size >= (off_t)UINT32_MAX) {
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the file has 4 GiB or more", path);
    }
    *size = (size_t)information.st_size;
    return LIMN_BAKE_OK;
}

static limn_bake_status load(limni_context *context, const char *path, size_t size, char *text) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        return limni_fail(context, LIMN_BAKE_IO, "%s: cannot be read: %s", path, strerror(errno));
    }
    errno = 0;
    const size_t read_size = fread(text, 1, size, file);
    const int error = errno;
    fclose(file);
    if (read_size != size) {
        return limni_fail(context, LIMN_BAKE_IO, "%s: cannot be read: %s", path,
                          error ? strerror(error) : "it became shorter meanwhile");
    }
    text[size] = '\0';
    return LIMN_BAKE_OK;
}

/// One source, but of a scene as many as there are meshes.
static limn_bake_status read_text(limni_context *context, const char *text, size_t size,
                                  const format *kind, const limni_source *named,
                                  limni_scene *scene) {
    if (kind->read_scene)
        return kind->read_scene(context, named->path, named->name, text, size, scene);
    scene->source_count = 1;
    scene->sources = limni_allocate(context, 1, sizeof *scene->sources);
    if (!scene->sources) return LIMN_BAKE_MEMORY;
    scene->sources[0] = *named;
    return kind->read_mesh(context, text, size, scene->sources);
}

limn_bake_status limni_read_scene(limni_context *context, const char *path, limni_scene *scene) {
    limni_source named = {0};
    size_t size = 0;
    scene->source_count = 0;
    LIMNI_TRY(find_size(context, path, &size));
    const format *const kind = find_format(path);
    if (!kind)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "%s: unknown kind of file; .obj, .off, .ply, .gltf, .glb, .fbx and .dae "
                          "are read",
                          path);
    LIMNI_TRY(name_source(context, path, &named));
    char *const text = limni_allocate(context, size + 1, 1);
    if (!text) return LIMN_BAKE_MEMORY;
    LIMNI_TRY(load(context, path, size, text));
    LIMNI_TRY(read_text(context, text, size, kind, &named, scene));
    limni_release(context, text);
    return LIMN_BAKE_OK;
}

limn_bake_status limni_read_mesh(limni_context *context, const char *path, const char *name,
                                 limni_source *source) {
    limni_character character = {0};
    limni_scene scene = {.character = &character};
    LIMNI_TRY(limni_read_scene(context, path, &scene));
    for (uint32_t s = 0; s < scene.source_count; s++) {
        *source = scene.sources[s];
        if (scene.source_count == 1 || (name && strcmp(source->name, name) == 0))
            return LIMN_BAKE_OK;
    }
    if (name)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: it has %u meshes, but no '%s'", path,
                          scene.source_count, name);
    return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: it has %u meshes, and one is needed", path,
                      scene.source_count);
}

limn_bake_status limni_read_file(limni_context *context, const char *path, limni_source *source) {
    return limni_read_mesh(context, path, NULL, source);
}
