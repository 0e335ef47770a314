/* SPDX-License-Identifier: MIT */
/* FBX and Collada, through assimp. docs/meshes.md says what is read, and what is lost. */
#include "assimp_reader.h"
#include "read_model.h"

#include <assimp/cimport.h>
#include <assimp/config.h>

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// ---- What is lost

static bool contains(const char *bytes, size_t size, const char *word) {
    const size_t length = strlen(word);
    const char *const end = bytes + size;
    while ((size_t)(end - bytes) >= length) {
        bytes = memchr(bytes, word[0], (size_t)(end - bytes) - length + 1);
        if (!bytes) return false;
        if (memcmp(bytes, word, length) == 0) return true;
        bytes++;
    }
    return false;
}

/// Assimp passes these over without a word, so they are looked for in the bytes of the file, where
/// they stand as they are, in text and in binary.
static void note_lost_words(const limni_assimp_reader *reader, const char *bytes, size_t size) {
    static const struct {
        bool is_fbx;
        const char *word, *what;
    } lost[] = {
        {true, "LayerElementEdgeCrease", "the sharpness of edges (LayerElementEdgeCrease) is lost"},
        {true, "LayerElementVertexCrease",
         "the sharpness of vertices (LayerElementVertexCrease) is lost"},
        {true, "LayerElementHole", "holes (LayerElementHole) are lost"},
        {true, "NurbsSurface", "NURBS are lost"},
        {true, "DualQuaternion", "joints are blended linearly, not as dual quaternions"},
        {true, "LayeredTexture", "of layered textures only the first is read"},
        {false, "<spline", "splines are lost"},
        {false, "<nurbs", "NURBS are lost"},
        {false, "<skew", "the skew of nodes is lost"},
        {false, "<ph>", "holes in polygons (<ph>) are lost"},
        {false, "BEZIER", "curves of animations (BEZIER) are taken as straight between their keys"},
        {false, "HERMITE",
         "curves of animations (HERMITE) are taken as straight between their keys"},
    };
    for (size_t w = 0; w < sizeof lost / sizeof *lost; w++) {
        if (lost[w].is_fbx == reader->is_fbx && contains(bytes, size, lost[w].word))
            limni_note(reader->context, "%s: %s", reader->model->path, lost[w].what);
    }
}

/// Some versions of assimp lose the morph targets of some files, or the meshes that have them.
static void note_lost_targets(const limni_assimp_reader *reader, const char *bytes, size_t size) {
    const char *const word = reader->is_fbx ? "BlendShapeChannel" : "<morph";
    for (unsigned m = 0; m < reader->scene->mNumMeshes; m++) {
        if (reader->scene->mMeshes[m]->mNumAnimMeshes) return;
    }
    if (contains(bytes, size, word))
        limni_note(reader->context,
                   "%s: assimp found no morph targets (%s), and maybe not the meshes that have "
                   "them",
                   reader->model->path, word);
}

/// A number among the metadata of a scene; `missing`, if it is not there.
static double find_number(const struct aiScene *scene, const char *key, double missing) {
    const struct aiMetadata *const data = scene->mMetaData;
    for (unsigned i = 0; data && i < data->mNumProperties; i++) {
        const void *const value = data->mValues[i].mData;
        if (!value || strcmp(data->mKeys[i].data, key) != 0) continue;
        switch (data->mValues[i].mType) {
        case AI_INT32:
            return *(const int32_t *)value;
        case AI_FLOAT:
            return (double)*(const float *)value;
        case AI_DOUBLE:
            return *(const double *)value;
        default:
            return missing;
        }
    }
    return missing;
}

static bool is_identity(const struct aiMatrix4x4 *m) {
    static const float identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    float rows[3][4];
    return limni_assimp_rows(m, rows) && memcmp(rows, identity, sizeof rows) == 0;
}

/// What FBX says about its space, and nobody does.
static void note_space(const limni_assimp_reader *reader) {
    const struct aiScene *const scene = reader->scene;
    const double unit = find_number(scene, "UnitScaleFactor", 1);
    const int up = (int)find_number(scene, "UpAxis", 1);
    if (!reader->is_fbx) return;
    if (is_identity(&scene->mRootNode->mTransformation) && up != 1)
        limni_note(reader->context, "%s: %c is up in it, and stays so", reader->model->path,
                   up == 0 ? 'x' : 'z');
    limni_note(reader->context, "%s: lengths are as in the file, in units of %g cm",
               reader->model->path, unit);
    if (scene->mNumAnimations)
        limni_note(reader->context,
                   "%s: curves of animations are taken as straight between their keys, and layers "
                   "are not blended",
                   reader->model->path);
}

// ---- Reading

static limn_bake_status read_document(limni_assimp_reader *reader, const char *bytes, size_t size) {
    if (!reader->scene->mRootNode)
        return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: it has no scene",
                          reader->model->path);
    note_lost_words(reader, bytes, size);
    note_lost_targets(reader, bytes, size);
    note_space(reader);
    LIMNI_TRY(limni_assimp_read_nodes(reader));
    LIMNI_TRY(limni_assimp_collapse_pivots(reader));
    LIMNI_TRY(limni_assimp_read_meshes(reader));
    LIMNI_TRY(limni_assimp_read_materials(reader));
    return limni_assimp_read_animations(reader);
}

/// Nothing is done to the scene after it has been read: no triangles, no welding.
static const struct aiScene *import(const char *bytes, size_t size, bool is_fbx) {
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    if (!properties) return NULL;
    // Bones that move nothing are joints all the same.
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_REMOVE_EMPTY_BONES, 0);
    // A skeleton alone is not to be made visible.
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    const struct aiScene *const scene = aiImportFileFromMemoryWithProperties(
        bytes, (unsigned)size, 0, is_fbx ? "fbx" : "dae", properties);
    aiReleasePropertyStore(properties);
    return scene;
}

/// Seconds that assimp may take for a file: some hundred times what it needs.
static rlim_t seconds_for(size_t size) {
    return 2 + (rlim_t)(size >> 20);
}

/// The signals that end a process, whatever the program does with them.
static void reset_signals(void) {
    static const int signals[] = {SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGXCPU};
    sigset_t none;
    for (size_t s = 0; s < sizeof signals / sizeof *signals; s++)
        signal(signals[s], SIG_DFL);
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

/// The other process: says a word if assimp came back.
static void try_import(const char *bytes, size_t size, bool is_fbx, int verdict) {
    const rlim_t seconds = seconds_for(size);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    reset_signals();
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    alarm((unsigned)(30 * seconds)); // where it waits for what no thread of this process gives back
    import(bytes, size, is_fbx);
    _exit(write(verdict, "", 1) == 1 ? 0 : 1);
}

/// Whether assimp comes back from a file. It aborts on some that are broken, and never ends with
/// others, so that it is tried in another process first. The word through the pipe counts, as a host
/// may collect its children by itself.
///
/// survived  out
static limn_bake_status try_apart(const limni_assimp_reader *reader, const char *bytes, size_t size,
                                  bool *survived) {
    int ends[2];
    const bool piped = pipe(ends) == 0;
    const pid_t child = piped ? fork() : -1;
    if (child == 0) try_import(bytes, size, reader->is_fbx, ends[1]);
    const int error = errno;
    if (piped) close(ends[1]);
    if (child < 0) {
        if (piped) close(ends[0]);
        return limni_fail(reader->context, LIMN_BAKE_IO, "%s: no process to try assimp in: %s",
                          reader->model->path, strerror(error));
    }
    char word;
    ssize_t length;
    do {
        length = read(ends[0], &word, 1);
    } while (length < 0 && errno == EINTR);
    close(ends[0]);
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR) {
    }
    *survived = length == 1;
    return LIMN_BAKE_OK;
}

static limn_bake_status refuse(const limni_assimp_reader *reader, const char *words) {
    return limni_fail(reader->context, LIMN_BAKE_BAD_INPUT, "%s: not good %s: %.255s",
                      reader->model->path, reader->is_fbx ? "FBX" : "Collada", words);
}

/// Assimp keeps its last error for the whole process.
static limn_bake_status import_scene(limni_assimp_reader *reader, const char *bytes, size_t size) {
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    limn_bake_status status = LIMN_BAKE_OK;
    pthread_mutex_lock(&one_at_a_time);
    reader->scene = import(bytes, size, reader->is_fbx);
    if (!reader->scene) {
        const char *const words = aiGetErrorString();
        status = refuse(reader, words && words[0] ? words : "assimp says no more");
    }
    pthread_mutex_unlock(&one_at_a_time);
    return status;
}

limn_bake_status limni_read_assimp(limni_context *context, const char *path, const char *name,
                                   const char *bytes, size_t size, limni_scene *scene) {
    limni_model model = {.path = path};
    limni_assimp_reader reader = {
        .context = context, .model = &model, .is_fbx = limni_has_extension(path, ".fbx")};
    if (size == 0) return refuse(&reader, "it is empty");
    bool survived = false;
    LIMNI_TRY(try_apart(&reader, bytes, size, &survived));
    if (!survived) return refuse(&reader, "assimp breaks down over it");
    LIMNI_TRY(import_scene(&reader, bytes, size));
    const limn_bake_status status = read_document(&reader, bytes, size);
    aiReleaseImport(reader.scene);
    return status == LIMN_BAKE_OK ? limni_read_model(context, &model, name, scene) : status;
}
