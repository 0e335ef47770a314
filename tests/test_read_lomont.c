/* SPDX-License-Identifier: MIT */
/* Lomont's extended OBJ. */
#include "readers.h"

#define MAGIC "#SubdivisionSurfL 0.1\n"
#define XYZ "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define TRIANGLE MAGIC XYZ "f 1 2 3\n"
#define OPEN "hd -1 inf\n"
#define ALL_OPEN OPEN OPEN OPEN
/* Lines 2 to 5, 6 and 7, 8 to 13. Half-edges 3 and 4 are a pair. */
#define PAIR MAGIC XYZ "v 1 1 0\nf 1 2 3\nf 1 3 4\n"
#define PAIR_READ "2:0,0,0 3:1,0,0 4:0,1,0 5:1,1,0  6:0,1,2 7:0,2,3"

static void test_good(void) {
    static const text_case meshes[] = {
        {TRIANGLE ALL_OPEN, "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {"\xef\xbb\xbf#SubdivisionSurfL \t0.1 # his\r\n" XYZ "f 1 2 3\r\n" ALL_OPEN,
         "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {MAGIC "f 3 2 1\n" ALL_OPEN XYZ, "6:0,0,0 7:1,0,0 8:0,1,0  2:2,1,0"},
        {PAIR OPEN OPEN "hd 4 2.5\nhd 3 2.5\n" OPEN OPEN, PAIR_READ},
        {MAGIC "si 3 1 3 0\n" XYZ "f 1 2 3\n" ALL_OPEN, "3:0,0,0 4:1,0,0 5:0,1,0  6:0,1,2"},
        {TRIANGLE ALL_OPEN "vc 1 1 1 1\nfc 0\nft 0 0 a\nfn 0 0 1 0\nfni 1 1 1\nspam\n",
         "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {MAGIC "si 3 1 3 1\n" XYZ "f 1 2 3\n" ALL_OPEN "fn 0 0 1 0\n",
         "3:0,0,0 4:1,0,0 5:0,1,0  6:0,1,2"},
    };
    static const text_case tags[] = {
        {TRIANGLE ALL_OPEN, "0 0"},
        {PAIR OPEN OPEN "hd 4 0\nhd 3 0\n" OPEN OPEN, "0 0"},
        {PAIR OPEN OPEN "hd 4 2.5\nhd 3 2.5\n" OPEN OPEN, "10:2-0=2.5 0 0"},
        {PAIR OPEN OPEN "hd 4 INF\nhd 3 infinity\n" OPEN "hd -1 3\n", "10:2-0=inf 0 0"},
        {TRIANGLE ALL_OPEN "vs 0\nvs 1.5\nvs inf\n", "10:1=1.5 11:2=inf 0 0"},
        {TRIANGLE ALL_OPEN "t crease 2/1/0 0 1 4\nt hole 1/0/0 3\nt interpolateboundary 1/0/0 1\n"
                           "t creasemethod 0/0/1 chaikin\n",
         "9:0-1=4 10:3 2 2"},
    };
    check_good(limni_read_obj, meshes, COUNT(meshes));
    check_described(limni_read_obj, tags, COUNT(tags), describe_tags);
}

static void test_bad(void) {
    static const text_case cases[] = {
        {"#SubdivisionSurfL", "t.obj:1: version '' of Lomont's format is unknown; 0.1 is expected"},
        {"#SubdivisionSurfL 0.10\n",
         "t.obj:1: version '0.10' of Lomont's format is unknown; 0.1 is expected"},
        {MAGIC, "t.obj: the file has no vertices"},
        {MAGIC XYZ, "t.obj: the file has no faces"},
        {MAGIC "v 0 0\n", "t.obj:2: vertex has 2 numbers; 3 are expected"},
        {MAGIC "v 0 0 0 1\n", "t.obj:2: vertex has 4 numbers; 3 are expected"},
        {MAGIC "f 1 2\n", "t.obj:2: the vertex of the face is missing"},
        {MAGIC "f 1 2 3 4\n", "t.obj:2: '4' after the third vertex of the face"},
        {MAGIC "f 1/1 2 3\n", "t.obj:2: '1/1' is not a valid vertex of the face"},
        {MAGIC "f 1 0 3\n", "t.obj:2: face refers to vertex 0, but they count from 1"},
        {MAGIC XYZ "f 1 2 4\n" ALL_OPEN, "t.obj:5: face refers to vertex 4, but the file has 3"},
        {TRIANGLE OPEN OPEN, "t.obj: the file has 2 entries hd; 3 are expected"},
        {TRIANGLE ALL_OPEN OPEN, "t.obj: the file has 4 entries hd; 3 are expected"},
        {TRIANGLE ALL_OPEN "vs 1\n", "t.obj: the file has 1 entries vs; 3 are expected"},
        {TRIANGLE "hd\n", "t.obj:6: the pair of the half-edge is missing"},
        {TRIANGLE "hd 1\n", "t.obj:6: the sharpness of the half-edge is missing"},
        {TRIANGLE "hd 1 1 1\n", "t.obj:6: '1' after the sharpness of the half-edge"},
        {TRIANGLE "hd 0 1\n", "t.obj:6: half-edges count from 1; -1 is a boundary"},
        {TRIANGLE "hd -2 1\n", "t.obj:6: '-2' is not a valid pair of a half-edge"},
        {TRIANGLE "hd 1 -1\n", "t.obj:6: sharpness is negative: '-1'"},
        {TRIANGLE "hd 1 nan\n", "t.obj:6: sharpness is not finite: 'nan'"},
        {TRIANGLE "vs\n", "t.obj:6: the sharpness of the vertex is missing"},
        {TRIANGLE "vs 1 1\n", "t.obj:6: '1' after the sharpness of the vertex"},
        {TRIANGLE "t crease\n", "t.obj:6: '' does not count the values of a tag; "
                                "INTS/FLOATS/STRINGS is expected"},
        {MAGIC "si 3 1 3\n", "t.obj:2: the normal count is missing"},
        {MAGIC "si 3 1 3 0 0\n", "t.obj:2: '0' after the counts"},
        {MAGIC "si 3 1 4 0\n" XYZ "f 1 2 3\n" ALL_OPEN,
         "t.obj:2: the file has 3 vertices, 1 faces, 3 edges and 0 normals, not what is stated "
         "here"},
        {TRIANGLE OPEN OPEN "hd 4 1\n", "t.obj:8: half-edge 3 is paired with half-edge 4, but the "
                                        "file has 3"},
        {TRIANGLE OPEN OPEN "hd 3 1\n", "t.obj:8: half-edges 3 and 3 are no pair"},
        {PAIR OPEN OPEN "hd 4 1\n" OPEN OPEN OPEN, "t.obj:10: half-edges 3 and 4 are no pair"},
        {PAIR OPEN "hd 4 1\n" OPEN "hd 2 1\n" OPEN OPEN, "t.obj:9: half-edges 2 and 4 are no pair"},
        {PAIR OPEN OPEN "hd 4 1\nhd 3 2\n" OPEN OPEN,
         "t.obj:10: half-edges 3 and 4 are a pair, but differ in sharpness"},
        {PAIR OPEN OPEN OPEN OPEN OPEN OPEN,
         "t.obj:10: half-edge 3 is on a boundary, but half-edge 4 runs the other way"},
    };
    check_bad(limni_read_obj, cases, COUNT(cases));
}

static void append_note(void *user, const char *text) {
    char *const notes = user;
    snprintf(notes + strlen(notes), 512 - strlen(notes), "%s\n", text);
}

static void test_notes(void) {
    static const char text[] = TRIANGLE "hd -1 10\nhd -1 9\nhd -1 0\nvc 1 1 1 1\nvc 1\nspam\n";
    char notes[512] = "";
    limni_context context = {.desc = {.note = append_note, .user = notes}};
    limni_source source;
    CHECK_EQUAL(read_text(&context, limni_read_obj, text, sizeof text - 1, &source), LIMN_BAKE_OK);
    CHECK_TEXT(notes, "t.obj:9: entry (a colour, texture or normal) 'vc' is ignored\n"
                      "t.obj:11: unknown entry 'spam' is ignored\n"
                      "t.obj:7: 2 boundary half-edges are not sharp for ever here; they are all "
                      "the same\n");
    limni_release_all(&context);
}

/// Another first line is another format.
static void test_other_magic(void) {
    static const text_case cases[] = {
        {" " TRIANGLE, "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {"#SubdivisionSurfLoop 0.1\n" XYZ "f 1 2 3\n", "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {"# SubdivisionSurfL 0.1\n" XYZ "f 1 2 3\n", "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
    };
    check_good(limni_read_obj, cases, COUNT(cases));
}

static const char sample[] =
    MAGIC "si 4 2 5 1\n" XYZ "v 1.5e0 -1 +.25\nf 1 2 3\nf 1 3 4\n" OPEN OPEN
          "hd 4 2.5\nhd 3 2.5\nhd -1 inf\nhd -1 10\nfn 0 0 1 0\nvs 0\nvs 1\nvs 2\nvs inf\n"
          "t crease 2/1/0 0 1 4\nt hole 1/0/0 1\n";

static void test_prefixes(void) {
    for (size_t size = 0; size < sizeof sample; size++)
        read_anything(limni_read_obj, sample, size);
    CHECK(read_anything(limni_read_obj, sample, sizeof sample - 1));
}

int main(void) {
    test_good();
    test_bad();
    test_notes();
    test_other_magic();
    test_prefixes();
    test_mutations(limni_read_obj, sample, sizeof sample - 1);
    return check_report();
}
