/* SPDX-License-Identifier: MIT */
/* The only file that knows tinygltf: copies its model into plain structs. */
#include "gltf.h"

#include "beside.h"

#include <tiny_gltf.h>

#include <sys/stat.h>

#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace {

/// Thrown where the context has no memory; it has recorded that.
struct out_of_memory {};

bool is_data(const std::string &uri) {
    return uri.compare(0, 5, "data:") == 0;
}

class copier {
  public:
    copier(limni_context *memory, limni_gltf *to) : context(memory), document(to) {}
    void copy(const tinygltf::Model &model);

  private:
    template <typename T> T *make(size_t count) {
        T *const items = static_cast<T *>(limni_allocate_zeroed(context, count, sizeof(T)));
        if (!items) throw out_of_memory();
        return items;
    }

    const char *text(const std::string &string) {
        char *const copy = make<char>(string.size() + 1);
        for (size_t c = 0; c < string.size(); c++)
            copy[c] = static_cast<unsigned char>(string[c]) < ' ' ? '_' : string[c];
        return copy;
    }

    template <typename T> T *array(const std::vector<T> &from, uint32_t *count) {
        T *const items = make<T>(from.size());
        if (!from.empty()) std::memcpy(items, from.data(), from.size() * sizeof(T));
        *count = static_cast<uint32_t>(from.size());
        return items;
    }

    /// Copies a vector item by item, with one of the functions below.
    template <typename T, typename From, typename Copy>
    T *each(const std::vector<From> &from, uint32_t *count, Copy copy_item) {
        T *const items = make<T>(from.size());
        for (size_t i = 0; i < from.size(); i++)
            (this->*copy_item)(from[i], &items[i]);
        *count = static_cast<uint32_t>(from.size());
        return items;
    }

    void copy_text(const std::string &from, const char **to) {
        *to = text(from);
    }
    void copy_buffer(const tinygltf::Buffer &from, limni_gltf_buffer *to);
    void copy_view(const tinygltf::BufferView &from, limni_gltf_view *to);
    void copy_accessor(const tinygltf::Accessor &from, limni_gltf_accessor *to);
    void copy_attributes(const std::map<std::string, int> &from, limni_gltf_attributes *to);
    void copy_primitive(const tinygltf::Primitive &from, limni_gltf_primitive *to);
    void copy_tags(const tinygltf::Value &from, limni_model_tags *to);
    void copy_mesh(const tinygltf::Mesh &from, limni_gltf_mesh *to);
    void copy_node(const tinygltf::Node &from, limni_model_node *to);
    void copy_skin(const tinygltf::Skin &from, limni_gltf_skin *to);
    void copy_animation(const tinygltf::Animation &from, limni_gltf_animation *to);
    void copy_material(const tinygltf::Material &from, limni_gltf_material *to);
    void copy_texture(const tinygltf::Texture &from, int *to) {
        *to = from.source;
    }
    void copy_image(const tinygltf::Image &from, limni_gltf_image *to);

    double *rows(const tinygltf::Value &from, const char *name, int width, uint32_t *count,
                 limni_model_tags *tags);

    limni_context *context;
    limni_gltf *document;
};

void copier::copy_buffer(const tinygltf::Buffer &from, limni_gltf_buffer *to) {
    unsigned char *const bytes = make<unsigned char>(from.data.size());
    if (!from.data.empty()) std::memcpy(bytes, from.data.data(), from.data.size());
    to->bytes = bytes;
    to->size = from.data.size();
}

void copier::copy_view(const tinygltf::BufferView &from, limni_gltf_view *to) {
    to->buffer = from.buffer;
    to->offset = from.byteOffset;
    to->size = from.byteLength;
    to->stride = static_cast<uint32_t>(from.byteStride);
}

void copier::copy_accessor(const tinygltf::Accessor &from, limni_gltf_accessor *to) {
    to->name = text(from.name);
    to->view = from.bufferView;
    to->offset = from.byteOffset;
    to->count = from.count;
    to->component_type = from.componentType;
    to->component_count =
        static_cast<uint32_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(from.type)));
    to->normalised = from.normalized;
    if (!from.sparse.isSparse) return;
    // A negative number becomes one that lies outside.
    to->sparse_count = static_cast<uint64_t>(from.sparse.count);
    to->sparse_index_view = from.sparse.indices.bufferView;
    to->sparse_index_type = from.sparse.indices.componentType;
    to->sparse_index_offset = static_cast<uint64_t>(from.sparse.indices.byteOffset);
    to->sparse_value_view = from.sparse.values.bufferView;
    to->sparse_value_offset = static_cast<uint64_t>(from.sparse.values.byteOffset);
}

void copier::copy_attributes(const std::map<std::string, int> &from, limni_gltf_attributes *to) {
    to->items = make<limni_gltf_attribute>(from.size());
    for (const auto &attribute : from)
        to->items[to->count++] = {text(attribute.first), attribute.second};
}

void copier::copy_primitive(const tinygltf::Primitive &from, limni_gltf_primitive *to) {
    copy_attributes(from.attributes, &to->attributes);
    to->targets =
        each<limni_gltf_attributes>(from.targets, &to->target_count, &copier::copy_attributes);
    to->indices = from.indices;
    to->material = from.material;
    to->mode = from.mode;
}

/// An array of arrays of `width` numbers, or the tags have a mistake.
double *copier::rows(const tinygltf::Value &from, const char *name, int width, uint32_t *count,
                     limni_model_tags *tags) {
    if (!from.Has(name)) return nullptr;
    const tinygltf::Value &list = from.Get(name);
    if (!list.IsArray()) {
        tags->mistake = text(std::string(name) + " is not an array");
        return nullptr;
    }
    double *const numbers = make<double>(list.ArrayLen() * static_cast<size_t>(width));
    for (size_t r = 0; r < list.ArrayLen(); r++) {
        const tinygltf::Value &row = list.Get(static_cast<int>(r));
        bool good = row.IsArray() && row.ArrayLen() == static_cast<size_t>(width);
        for (int i = 0; good && i < width; i++) {
            good = row.Get(i).IsNumber();
            if (good)
                numbers[r * static_cast<size_t>(width) + static_cast<size_t>(i)] =
                    row.Get(i).GetNumberAsDouble();
        }
        if (!good && !tags->mistake)
            tags->mistake = text(std::string(name) + "[" + std::to_string(r) + "] is not " +
                                 std::to_string(width) + " numbers");
    }
    *count = static_cast<uint32_t>(list.ArrayLen());
    return numbers;
}

void copier::copy_tags(const tinygltf::Value &from, limni_model_tags *to) {
    to->boundary = to->creasing = "";
    if (!from.Has("limn")) return;
    const tinygltf::Value &limn = from.Get("limn");
    if (!limn.IsObject()) {
        to->mistake = "it is not an object";
        return;
    }
    to->creases = reinterpret_cast<double(*)[3]>(rows(limn, "creases", 3, &to->crease_count, to));
    to->corners = reinterpret_cast<double(*)[2]>(rows(limn, "corners", 2, &to->corner_count, to));
    for (const std::string &key : limn.Keys()) {
        const tinygltf::Value &value = limn.Get(key);
        const bool boundary = key == "boundary";
        if (key == "creases" || key == "corners") continue;
        if (!boundary && key != "creasing")
            to->mistake = text("there is no '" + key + "'");
        else if (!value.IsString())
            to->mistake = text(key + " is not a string");
        else
            (boundary ? to->boundary : to->creasing) = text(value.Get<std::string>());
    }
}

void copier::copy_mesh(const tinygltf::Mesh &from, limni_gltf_mesh *to) {
    to->name = text(from.name);
    to->primitives =
        each<limni_gltf_primitive>(from.primitives, &to->primitive_count, &copier::copy_primitive);
    to->weights = array(from.weights, &to->weight_count);
    copy_tags(from.extras, &to->tags);
    if (!from.extras.Has("targetNames")) return;
    const tinygltf::Value &names = from.extras.Get("targetNames");
    to->target_names = make<const char *>(names.ArrayLen());
    for (size_t n = 0; n < names.ArrayLen(); n++) {
        const tinygltf::Value &name = names.Get(static_cast<int>(n));
        to->target_names[n] = name.IsString() ? text(name.Get<std::string>()) : "";
    }
    to->target_name_count = static_cast<uint32_t>(names.ArrayLen());
}

/// Numbers of a node, if there are any; false where there are not as many as there should be.
bool take(const std::vector<double> &from, size_t count, double *to) {
    if (from.size() == count) std::memcpy(to, from.data(), count * sizeof *to);
    return from.empty() || from.size() == count;
}

void copier::copy_node(const tinygltf::Node &from, limni_model_node *to) {
    to->name = text(from.name);
    to->mesh = from.mesh;
    to->skin = from.skin;
    to->has_camera = from.camera >= 0;
    to->children = array(from.children, &to->child_count);
    to->rotation[3] = 1;
    to->scale[0] = to->scale[1] = to->scale[2] = 1;
    to->has_matrix = from.matrix.size() == 16;
    if (!take(from.matrix, 16, to->matrix)) to->mistake = "its matrix is not 16 numbers";
    if (!take(from.translation, 3, to->translation))
        to->mistake = "its translation is not 3 numbers";
    if (!take(from.rotation, 4, to->rotation)) to->mistake = "its rotation is not 4 numbers";
    if (!take(from.scale, 3, to->scale)) to->mistake = "its scale is not 3 numbers";
    to->weights = array(from.weights, &to->weight_count);
}

void copier::copy_skin(const tinygltf::Skin &from, limni_gltf_skin *to) {
    to->name = text(from.name);
    to->joints = array(from.joints, &to->joint_count);
    to->inverse_binds = from.inverseBindMatrices;
}

void copier::copy_animation(const tinygltf::Animation &from, limni_gltf_animation *to) {
    to->name = text(from.name);
    to->channels = make<limni_gltf_channel>(from.channels.size());
    to->channel_count = static_cast<uint32_t>(from.channels.size());
    for (size_t c = 0; c < from.channels.size(); c++) {
        const tinygltf::AnimationChannel &channel = from.channels[c];
        limni_gltf_channel *const copy = &to->channels[c];
        copy->node = channel.target_node;
        copy->path = text(channel.target_path);
        copy->input = copy->output = -1;
        copy->interpolation = "";
        if (channel.sampler < 0 || static_cast<size_t>(channel.sampler) >= from.samplers.size())
            continue;
        const tinygltf::AnimationSampler &sampler =
            from.samplers[static_cast<size_t>(channel.sampler)];
        copy->input = sampler.input;
        copy->output = sampler.output;
        copy->interpolation = text(sampler.interpolation);
    }
}

void copier::copy_material(const tinygltf::Material &from, limni_gltf_material *to) {
    const tinygltf::PbrMetallicRoughness &pbr = from.pbrMetallicRoughness;
    std::string ignored;
    const auto note = [&ignored](bool is_there, const char *what) {
        if (is_there) ignored += (ignored.empty() ? "" : ", ") + std::string(what);
    };
    note(pbr.metallicRoughnessTexture.index >= 0, "metallicRoughnessTexture");
    note(from.normalTexture.index >= 0, "normalTexture");
    note(from.occlusionTexture.index >= 0, "occlusionTexture");
    note(from.emissiveTexture.index >= 0, "emissiveTexture");
    to->name = text(from.name);
    to->ignored = text(ignored);
    for (size_t i = 0; i < 4; i++)
        to->base_colour[i] = i < pbr.baseColorFactor.size() ? pbr.baseColorFactor[i] : 1;
    to->base_texture = pbr.baseColorTexture.index;
    to->base_channel = static_cast<uint32_t>(pbr.baseColorTexture.texCoord);
}

void copier::copy_image(const tinygltf::Image &from, limni_gltf_image *to) {
    to->name = text(from.name);
    to->uri = is_data(from.uri) ? "" : text(from.uri); // data of a type that tinygltf does not know
    to->view = from.bufferView;
    if (from.image.empty()) return;
    unsigned char *const bytes = make<unsigned char>(from.image.size());
    std::memcpy(bytes, from.image.data(), from.image.size());
    to->bytes = bytes;
    to->size = from.image.size();
}

void copier::copy(const tinygltf::Model &model) {
    limni_gltf *const d = document;
    d->buffers = each<limni_gltf_buffer>(model.buffers, &d->buffer_count, &copier::copy_buffer);
    d->views = each<limni_gltf_view>(model.bufferViews, &d->view_count, &copier::copy_view);
    d->accessors =
        each<limni_gltf_accessor>(model.accessors, &d->accessor_count, &copier::copy_accessor);
    d->meshes = each<limni_gltf_mesh>(model.meshes, &d->mesh_count, &copier::copy_mesh);
    d->nodes = each<limni_model_node>(model.nodes, &d->node_count, &copier::copy_node);
    d->skins = each<limni_gltf_skin>(model.skins, &d->skin_count, &copier::copy_skin);
    d->animations =
        each<limni_gltf_animation>(model.animations, &d->animation_count, &copier::copy_animation);
    d->materials =
        each<limni_gltf_material>(model.materials, &d->material_count, &copier::copy_material);
    d->textures = each<int>(model.textures, &d->texture_count, &copier::copy_texture);
    d->images = each<limni_gltf_image>(model.images, &d->image_count, &copier::copy_image);
    d->extensions =
        each<const char *>(model.extensionsUsed, &d->extension_count, &copier::copy_text);
    d->required_extensions = each<const char *>(model.extensionsRequired,
                                                &d->required_extension_count, &copier::copy_text);
    d->has_scene = !model.scenes.empty();
    if (!d->has_scene) return;
    const size_t scene = static_cast<size_t>(model.defaultScene);
    d->roots = array(model.scenes[scene < model.scenes.size() ? scene : 0].nodes, &d->root_count);
}

// ---- Loading

/// Keeps an image as it was. What lies in a buffer view stays there: its bounds are not checked.
bool keep_image(tinygltf::Image *image, int, std::string *, std::string *, int, int,
                const unsigned char *bytes, int size, void *) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// Where the files that a document names may be.
struct surroundings {
    std::string folder;
    std::string mistake; ///< of the file that was asked for last
};

/// What is wrong with a file by its path, relative to the folder; "": nothing.
std::string find_mistake(const std::string &folder, const std::string &path) {
    struct stat information;
    if (path.empty()) return "it names no file";
    if (is_data(path)) return "its data URI has a type that is not read";
    if (limni_leaves_folder(path.c_str()))
        return "'" + path + "' leaves the folder of the document";
    if (stat((folder + "/" + path).c_str(), &information) != 0)
        return "'" + path + "' cannot be found";
    if (!S_ISREG(information.st_mode)) return "'" + path + "' is not a regular file";
    return "";
}

/// Only files in the document's folder or below: tinygltf would look in the working folder, too.
bool is_beside(const std::string &path, void *user) {
    surroundings *const around = static_cast<surroundings *>(user);
    const size_t start = around->folder.size() + 1;
    if (path.compare(0, start, around->folder + "/") != 0) return false;
    around->mistake = find_mistake(around->folder, path.substr(start));
    return around->mistake.empty();
}

/// Nothing in a path is expanded.
std::string keep_path(const std::string &path, void *) {
    return path;
}

std::string folder_of(const char *path) {
    const char *slash = std::strrchr(path, '/');
    if (!slash) return ".";
    while (slash > path && slash[-1] == '/')
        slash--;
    return slash == path ? "/." : std::string(path, slash);
}

/// The library's words in one line.
std::string in_one_line(const std::string &words) {
    std::string line;
    for (const char c : words) {
        if (static_cast<unsigned char>(c) >= ' ')
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return line.empty() ? "it says no more" : line;
}

/// The words for a buffer that could not be read; as they are, if it was not a buffer. tinygltf
/// names none, and may repeat all of a data URI.
std::string name_buffer(const std::string &words, const tinygltf::Model &model,
                        const surroundings &around) {
    const auto has = [&words](const char *part) { return words.find(part) != std::string::npos; };
    const std::string name = "buffer " + std::to_string(model.buffers.size()) + ": ";
    if (has("Failed to decode 'uri' : "))
        return name + "its data URI is damaged, or has another size than byteLength";
    if (has("File not found : ")) return name + around.mistake;
    if (has("File ") || has("in Buffer")) return name + words;
    return words;
}

/// Four bytes of a .glb.
uint32_t length_at(const char *bytes, size_t at) {
    uint32_t length;
    std::memcpy(&length, bytes + at, sizeof length);
    return length;
}

std::string json_of(const char *bytes, size_t size, bool binary) {
    const size_t header = binary ? 20 : 0;
    return std::string(bytes + header, binary ? length_at(bytes, 12) : size);
}

/// Whether a whole number that 32 bits hold follows wherever good JSON has a name: tinygltf takes
/// others for 0, or cuts them off.
///
/// alone  only numbers are looked at: an application may have something of its own by this name
bool are_counts(const std::string &json, const char *name, bool alone) {
    const char *const blanks = " \t\r\n";
    const std::string quoted = "\"" + std::string(name) + "\"";
    for (size_t at = 0; (at = json.find(quoted, at)) != std::string::npos;) {
        at = json.find_first_not_of(blanks, at + quoted.size());
        if (json[at] != ':') continue; // the name is a text
        at = json.find_first_not_of(blanks, at + 1);
        const size_t end = json.find_first_not_of("0123456789", at);
        const bool whole = end != at && !std::strchr(".eE", json[end]);
        if (whole ? end - at > 10 || std::stoull(json.substr(at, end - at)) > UINT32_MAX : !alone)
            return false;
    }
    return true;
}

/// What is wrong with the lengths in a .glb; "": nothing.
std::string find_cut(const char *bytes, size_t size) {
    const std::string sizes = std::to_string(size) + " bytes";
    if (size < 20) return "it has " + sizes + ", and a header alone has 20";
    if (length_at(bytes, 8) > size)
        return "its header says " + std::to_string(length_at(bytes, 8)) + " bytes, but it has " +
               sizes;
    for (size_t at = 12; at + 8 <= size;) {
        const size_t length = length_at(bytes, at);
        if (length > size - at - 8)
            return "a chunk of " + std::to_string(length) + " bytes from byte " +
                   std::to_string(at + 8) + " on reaches beyond its " + sizes;
        at += 8 + length;
    }
    return "";
}

bool load(const char *path, const char *bytes, size_t size, tinygltf::Model *model,
          std::string *error) {
    surroundings around = {folder_of(path), ""};
    std::string warnings;
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_image, nullptr);
    loader.SetFsCallbacks(
        {is_beside, keep_path, tinygltf::ReadWholeFile, tinygltf::WriteWholeFile, &around});
    const bool binary = size >= 4 && std::memcmp(bytes, "glTF", 4) == 0;
    const unsigned int length = static_cast<unsigned int>(size);
    if (binary && !(*error = find_cut(bytes, size)).empty()) return false;
    bool good =
        binary ? loader.LoadBinaryFromMemory(model, error, &warnings,
                                             reinterpret_cast<const unsigned char *>(bytes), length,
                                             around.folder)
               : loader.LoadASCIIFromString(model, error, &warnings, bytes, length, around.folder);
    if (!good) *error = name_buffer(*error, *model, around);
    // What it says of colours and goes on without; it also complains of what is good.
    if (error->find("`baseColorFactor`") != std::string::npos) good = false;
    const std::string json = json_of(bytes, size, binary);
    for (const char *const name : {"byteOffset", "byteStride", "byteLength", "count"}) {
        const bool alone = std::strcmp(name, "count") == 0 || std::strcmp(name, "byteLength") == 0;
        if (!good || are_counts(json, name, alone)) continue;
        *error = std::string(name) + " is not a whole number from 0 to 4294967295";
        good = false;
    }
    return good;
}

} // namespace

limn_bake_status limni_gltf_parse(limni_context *context, const char *path, const char *bytes,
                                  size_t size, limni_gltf *document) {
    std::memset(document, 0, sizeof *document);
    document->path = path;
    try {
        tinygltf::Model model;
        std::string error;
        if (!load(path, bytes, size, &model, &error))
            return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: not good glTF: %s", path,
                              in_one_line(error).c_str());
        if (model.asset.version.compare(0, 2, "2.") != 0)
            return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                              "%s: glTF version '%s', but only 2 is read", path,
                              in_one_line(model.asset.version).c_str());
        copier(context, document).copy(model);
        return LIMN_BAKE_OK;
    } catch (const out_of_memory &) {
        return LIMN_BAKE_MEMORY;
    } catch (const std::bad_alloc &) {
        return limni_fail(context, LIMN_BAKE_MEMORY, "%s: out of memory", path);
    } catch (const std::exception &exception) {
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: not good glTF: %s", path,
                          in_one_line(exception.what()).c_str());
    }
}
