/* SPDX-License-Identifier: MIT */
/* PLY, as text and binary. */
#include "readers.h"

#define START "ply\nformat ascii 1.0\n"
#define XYZ "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES "element face 1\nproperty list uchar int vertex_indices\n"
#define HEADER START XYZ FACES "end_header\n" /* 9 lines */
#define POINTS "0 0 0\n1 0 0\n0 1 0\n"
#define READ "10:0,0,0 11:1,0,0 12:0,1,0  13:0,1,2"

static void test_good_text(void) {
    static const text_case cases[] = {
        {HEADER POINTS "3 0 1 2\n", READ},
        {HEADER POINTS "3 0 1 2", READ},
        {HEADER "\n 0 0 0\n1\t0 0\n\n0 1 0 \n4 0 1 2 1\n\n",
         "11:0,0,0 12:1,0,0 14:0,1,0  15:0,1,2,1"},
        {"ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
         "property float z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n"
         "end_header \r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
         READ},
        {"ply\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\r"
         "property float z\relement face 1\rproperty list uchar int vertex_indices\r"
         "end_header\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r",
         READ},
        {"ply\ncomment C:\\models\\\nformat ascii 1.0\nobj_info # end_header\n"
         "element material 1\nproperty uchar red\n"
         "element vertex 3\nproperty double z\nproperty list uint8 float32 w\nproperty int16 y\n"
         "property uint x\nproperty float nx\nelement nothing 4000000000\n"
         "element face 2\nproperty char flag\nproperty list int uint32 vertex_index\n"
         "property list uchar uchar more\nend_header\n255\n-.5 2 a b -7 1 nan\n0 0 0 0 x\n"
         "1e3 1 c 0 0 nan\n-1 3 0 1 2 0\n0 4 2 1 0 1 2 9 9\n",
         "20:1,-7,-0.5 21:0,0,0 22:0,0,1000  23:0,1,2 24:2,1,0,1"},
    };
    check_good(limni_read_ply, cases, COUNT(cases));
}

static void test_bad_text(void) {
    static const text_case cases[] = {
        {"", "t.ply:1: the first line must be 'ply'"},
        {"ply", "t.ply:1: the first line must be 'ply'"},
        {"plyx\n", "t.ply:1: the first line must be 'ply'"},
        {"ply\n", "t.ply: the header does not end"},
        {"ply\nend_header", "t.ply: the header does not end"},
        {"ply\nend_header\n", "t.ply: the header states no format"},
        {"ply\nformat text 1.0\nend_header\n",
         "t.ply:2: 'text' is not a format; ascii, binary_little_endian or binary_big_endian is "
         "expected"},
        {"ply\nformat ascii 1.1\nend_header\n", "t.ply:2: '1.1' is not a known version; 1.0 is"},
        {"ply\nformat ascii 1.0 1\nend_header\n", "t.ply:2: '1' is too much here"},
        {START "spam\nend_header\n", "t.ply:3: 'spam' is not a word of the header"},
        {START "property float x\nend_header\n", "t.ply:3: a property before the first element"},
        {START "element vertex -1\nend_header\n", "t.ply:3: '-1' is not a valid element count"},
        {START "element vertex\nend_header\n", "t.ply:3: '' is not a valid element count"},
        {START "element vertex 4294967296\nend_header\n",
         "t.ply:3: element count 4294967296 is too large"},
        {START "element vertex 1\nelement vertex 1\nend_header\n",
         "t.ply:4: the element 'vertex' comes twice"},
        {START "element vertex 1\nproperty half x\nend_header\n", "t.ply:4: 'half' is not a type"},
        {START "element face 1\nproperty list float int vertex_indices\nend_header\n",
         "t.ply:4: 'float' is not a type of whole numbers"},
        {START "element face 1\nproperty list uchar float vertex_indices\nend_header\n",
         "t.ply:4: 'vertex_indices' is not a list of whole numbers"},
        {START "element vertex 1\nproperty float x\nproperty float x\nend_header\n",
         "t.ply:5: the property 'x' comes twice"},
        {START "element vertex 1\nproperty float x\nproperty float y\nend_header\n",
         "t.ply: the element vertex has no property z"},
        {START XYZ "end_header\n", "t.ply: the element face has no list vertex_indices"},
        {START XYZ "element face 1\nproperty int vertex_indices\nend_header\n",
         "t.ply: the element face has no list vertex_indices"},
        {"ply\nformat ascii 1.0\n\x01\nend_header\n",
         "t.ply:3: byte 0x01 does not belong in a text file"},
        {HEADER POINTS, "t.ply: the file ends too early for 1 elements 'face'"},
        {START
         "element vertex 4294967295\nproperty char x\nproperty char y\nproperty char z\n" FACES
         "end_header\n0 0 0\n",
         "t.ply: the file ends too early for 4294967295 elements 'vertex'"},
        {HEADER "0 0.00\n1 0 0\n0 1 0\n3 0 1 2\n", "t.ply:10: the line ends too early"},
        {HEADER "0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "t.ply:10: '0' is too much here"},
        {HEADER "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "t.ply:10: coordinate is not finite: 'nan'"},
        {HEADER "0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n", "t.ply:10: 'x' is not a number"},
        {HEADER POINTS "3 0 1\n", "t.ply:13: the line ends too early"},
        {HEADER POINTS "4294967295 0 1\n", "t.ply:13: the line ends too early"},
        {HEADER POINTS "2 0 1\n", "t.ply:13: face has fewer than 3 corners"},
        {HEADER POINTS "-3 0 1\n", "t.ply:13: '-3' is not a valid whole number"},
        {HEADER POINTS "3 0 1 3\n", "t.ply:13: face refers to a vertex that is not there"},
        {HEADER POINTS "3 0 1 2\n3 0 1 2\n", "t.ply:14: '3' after the last element"},
        {HEADER "0.00 0.00 0.00\n1.00 0.00 0.00\n0.0 1.0 0.0\n",
         "t.ply:13: the file ends after 0 of 1 elements 'face'"},
        {START "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 0\nproperty list uchar int vertex_indices\nend_header\n",
         "t.ply: the file has no vertices"},
    };
    check_bad(limni_read_ply, cases, COUNT(cases));
}

// ---- Binary

typedef struct bytes {
    char text[1024];
    size_t size;
    bool big;
} bytes;

static void append_text(bytes *file, const char *text) {
    memcpy(file->text + file->size, text, strlen(text));
    file->size += strlen(text);
}

/// A value of 1, 2, 4 or 8 bytes, in the byte order of the file.
static void append(bytes *file, uint64_t bits, size_t size) {
    for (size_t b = 0; b < size; b++)
        file->text[file->size++] = (char)(bits >> 8 * (file->big ? size - 1 - b : b));
}

static void append_float(bytes *file, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    append(file, bits, 4);
}

static void append_double(bytes *file, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    append(file, bits, 8);
}

/// Every type once, and bytes that look like text among the values.
static void make_binary(bytes *file, bool big) {
    *file = (bytes){.big = big};
    append_text(file, big ? "ply\nformat binary_big_endian 1.0\n"
                          : "ply\nformat binary_little_endian 1.0\n");
    append_text(file, "element vertex 3\nproperty double x\nproperty short y\nproperty float z\n"
                      "property ushort skipped\nproperty list uint char more\n"
                      "element face 2\nproperty list int uint vertex_indices\nproperty int8 flag\n"
                      "end_header\n");
    for (int v = 0; v < 3; v++) {
        append_double(file, v == 0 ? 0.1 : v);
        append(file, (uint64_t)(v - 300), 2);
        append_float(file, -0.5f * (float)v);
        append(file, '\n', 2);
        append(file, (uint64_t)v, 4);
        for (int m = 0; m < v; m++)
            append(file, '#', 1);
    }
    for (uint32_t face = 0; face < 2; face++) {
        append(file, 3, 4);
        for (uint32_t c = 0; c < 3; c++)
            append(file, face ? 2 - c : c, 4);
        append(file, 0xff, 1);
    }
}

static void test_good_binary(void) {
    for (int big = 0; big < 2; big++) {
        bytes file;
        limni_context context = {0};
        limni_source source;
        make_binary(&file, big);
        const limn_bake_status status =
            read_text(&context, limni_read_ply, file.text, file.size, &source);
        CHECK_TEXT(context.error, "");
        if (CHECK_EQUAL(status, LIMN_BAKE_OK)) {
            CHECK(is_valid(&source) && !source.position_lines && !source.face_lines);
            CHECK_TEXT(describe(&source), "0:0.1,-300,-0 0:1,-299,-0.5 0:2,-298,-1  0:0,1,2 "
                                          "0:2,1,0");
        }
        limni_release_all(&context);
    }
}

static void check_binary_error(const bytes *file, const char *error) {
    limni_context context = {0};
    limni_source source;
    CHECK_EQUAL(read_text(&context, limni_read_ply, file->text, file->size, &source),
                LIMN_BAKE_BAD_INPUT);
    CHECK_CONTAINS(context.error, error);
    limni_release_all(&context);
}

static void test_bad_binary(void) {
    bytes file;
    make_binary(&file, false);
    const size_t last_face = file.size - 17, first_vertex = file.size - 34 - 63;
    for (size_t size = file.size - 34; size < file.size; size++) {
        bytes shorter = file;
        shorter.size = size;
        check_binary_error(&shorter, "the file ends too early");
    }
    append(&file, 0, 1);
    check_binary_error(&file, "t.ply: 1 bytes after the last element");

    make_binary(&file, false);
    file.text[last_face] = 2;
    check_binary_error(&file, "face 1, byte ");
    check_binary_error(&file, ": face has fewer than 3 corners");
    file.text[last_face + 3] = (char)0xff;
    check_binary_error(&file, ": a list has a negative size");
    make_binary(&file, false);
    file.text[last_face + 4] = 3;
    check_binary_error(&file, ": face refers to a vertex that is not there");
    make_binary(&file, false);
    file.text[first_vertex + 6] = (char)0xf0;
    file.text[first_vertex + 7] = 0x7f;
    check_binary_error(&file, "t.ply: vertex 0, byte ");
    check_binary_error(&file, ": coordinate is not finite");
}

static void test_damaged_binary(void) {
    bytes file;
    for (int big = 0; big < 2; big++) {
        make_binary(&file, big);
        for (size_t size = 0; size < file.size; size++)
            CHECK(!read_anything(limni_read_ply, file.text, size));
        CHECK(read_anything(limni_read_ply, file.text, file.size));
        test_mutations(limni_read_ply, file.text, file.size);
    }
}

static const char sample[] = HEADER "0 0 0\n1 0 0\n1.5e0 -1 +.25\n3 0 1 2\n";

int main(void) {
    test_good_text();
    test_bad_text();
    test_good_binary();
    test_bad_binary();
    test_damaged_binary();
    for (size_t size = 0; size < sizeof sample; size++)
        read_anything(limni_read_ply, sample, size);
    test_mutations(limni_read_ply, sample, sizeof sample - 1);
    return check_report();
}
