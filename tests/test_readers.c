/* SPDX-License-Identifier: MIT */
/* The strict mesh readers: good texts, bad texts with their messages, damaged texts, real files. */
#define _POSIX_C_SOURCE 200809L /* truncate, mkdir */

#include "readers.h"

#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

#define XYZ "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define XYZ_READ "1:0,0,0 2:1,0,0 3:0,1,0 "

static void test_good_obj(void) {
    static const text_case cases[] = {
        {XYZ "f 1 2 3\n", XYZ_READ " 4:0,1,2"},
        {XYZ "f 1 2 3", XYZ_READ " 4:0,1,2"},
        {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", XYZ_READ " 4:0,1,2"},
        {"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", XYZ_READ " 4:0,1,2"},
        {"\xef\xbb\xbf" XYZ "f 1 2 3\n", XYZ_READ " 4:0,1,2"},
        {"v\t0 0  0 \n \tv 1 0 0\t\nv 0 1 0 # up\n\tf 1 2 3 #4\n", XYZ_READ " 4:0,1,2"},
        {"#\n" XYZ "f 1 2 3 # 4\n", "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {XYZ "# C:\\models\\\nf 1 2 3\n", XYZ_READ " 5:0,1,2"},
        {XYZ "f 3 2 1\nf -3 -2 -1\n", XYZ_READ " 4:2,1,0 5:0,1,2"},
        {XYZ "f -3 -2 -1\nv 5 5 5\nf -1 -3 -2\n", "1:0,0,0 2:1,0,0 3:0,1,0 5:5,5,5  4:0,1,2 "
                                                  "6:3,1,2"},
        {"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "2:0,0,0 3:1,0,0 4:0,1,0  1:0,1,2"},
        {XYZ "v 1 1 0\nf 1 2 4 3\nf 1 1 1\n", XYZ_READ "4:1,1,0  5:0,1,3,2 6:0,0,0"},
        {XYZ "vt 0\nvt 0 1\nvt 0 1 0\nvn 0 0 1\nf 1/1/1 2/-2/-1 3/3/1\nf 1//1 2//1 3//-1\n"
             "f 1/1 2/2 3/-1\n",
         XYZ_READ " 8:0,1,2 9:0,1,2 10:0,1,2"},
        {"v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0 1 1 1 1\nf 1 2 3\n", XYZ_READ " 4:0,1,2"},
        {XYZ "f 1 \\\n 2\\\n3\nf 3 2 1\n", XYZ_READ " 4:0,1,2 7:2,1,0"},
        {XYZ "f 1 \\\r\n2 3\r\nf 3 2 1\r\n", XYZ_READ " 4:0,1,2 6:2,1,0"},
        {"v +1. -.5 1e3\nv -0 1E-2 1e+2\nv 00001 1e-60 0.000\nf 1 2 3\n",
         "1:1,-0.5,1000 2:-0,0.01,100 3:1,0,0  4:0,1,2"},
        {"mtllib a b.mtl\no caf\xc3\xa9\ng\ns off\nusemtl caf\xe9\n" XYZ
         "l 1 2\np 1\nvp 0 0\nt crease 2/1/0 1 2 4.0\nf 1 2 3\ng \\\nf 1 2\n",
         "6:0,0,0 7:1,0,0 8:0,1,0  13:0,1,2"},
    };
    check_good(limni_read_obj, cases, COUNT(cases));
}

static void test_channels(void) {
    static const text_case cases[] = {
        {XYZ "f 1 2 3\n", ""},
        {XYZ "vt 0 1\nf 1 2 3\n", ""},
        {XYZ "vt 1\nvt 2 3\nvt 4 5 6\nf 1/1 2/2 3/-1\nf 1/2/1 3/2/1 2/2\nvn 0 0 1\n",
         "uv: 1,0,0 2,3,0 4,5,0  0 1 2 1 1 1"},
        {XYZ "vt 7 8\nf 1/2 2 3//1\nvt 8 9\nvn 0 0 1\nf 2 3 1\n",
         "uv: 7,8,0 8,9,0 0,0,0  1 2 2 2 2 2"},
    };
    check_described(limni_read_obj, cases, COUNT(cases), describe_channels);
}

static void test_bad_obj(void) {
    static const text_case cases[] = {
        {"", "t.obj: the file has no vertices"},
        {"# only this\n", "t.obj: the file has no vertices"},
        {"f 1 2 3\n", "t.obj: the file has no vertices"},
        {XYZ, "t.obj: the file has no faces"},
        {"v 1 2\n", "t.obj:1: vertex has 2 numbers; 3 to 7 are expected"},
        {"v 1 # 2 3\n", "t.obj:1: vertex has 1 number; 3 to 7 are expected"},
        {"v\n", "t.obj:1: vertex has 0 numbers; 3 to 7 are expected"},
        {"v 1 2 3 4 5 6 7 8\n", "t.obj:1: vertex has 8 numbers; 3 to 7 are expected"},
        {"\n\nv 0 0 x1\n", "t.obj:3: 'x1' is not a number"},
        {"v 0 0 1.0abc\n", "t.obj:1: '1.0abc' is not a number"},
        {"v 0 0 1#\n", "t.obj:1: '1#' is not a number"},
        {"v 0 0 0x10\n", "t.obj:1: '0x10' is not a number"},
        {"v 0 0 1,5\n", "t.obj:1: '1,5' is not a number"},
        {"v 0 0 .\n", "t.obj:1: '.' is not a number"},
        {"v 0 0 -\n", "t.obj:1: '-' is not a number"},
        {"v 0 0 1e\n", "t.obj:1: '1e' is not a number"},
        {"v 0 0 1e+ 5\n", "t.obj:1: '1e+' is not a number"},
        {"v 0 0 0 red\n", "t.obj:1: 'red' is not a number"},
        {"v 0 0 nan\n", "t.obj:1: coordinate is not finite: 'nan'"},
        {"v 0 0 -Infinity\n", "t.obj:1: coordinate is not finite: '-Infinity'"},
        {"v 0 0 -nan(ind)\n", "t.obj:1: coordinate is not finite: '-nan(ind)'"},
        {"v 0 0 1e39\n", "t.obj:1: coordinate is not finite: '1e39'"},
        {"v 0 0 3.4028236e38\n", "t.obj:1: coordinate is not finite: '3.4028236e38'"},
        {"v 0 \\\n\\\n 0 x\n", "t.obj:3: 'x' is not a number"},
        {"v 0 0 0\\", "t.obj:1: '0\\' is not a number"},
        {"v 0 0 aaaaaaaaaabbbbbbbbbbccccccccccdddddddddeeee\n",
         "t.obj:1: 'aaaaaaaaaabbbbbbbbbbccccccccccddddddddde' is not a number"},
        {"v 0 0 aaaaaaaaaabbbbbbbbbbccccccccccddddddddd\xc3\xa9\n",
         "t.obj:1: 'aaaaaaaaaabbbbbbbbbbccccccccccddddddddd' is not a number"},
        {"vt\n", "t.obj:1: texture coordinate has 0 numbers; 1 to 3 are expected"},
        {"vt 0 0 0 0\n", "t.obj:1: texture coordinate has 4 numbers; 1 to 3 are expected"},
        {"vt 0 a\n", "t.obj:1: 'a' is not a number"},
        {"vn 0 1\n", "t.obj:1: normal has 2 numbers; 3 are expected"},
        {"vn 0 0 inf\n", "t.obj:1: coordinate is not finite: 'inf'"},
        {XYZ "f 1 2\n", "t.obj:4: face has 2 corners; at least 3 are needed"},
        {XYZ "f 1 # 2 3\n", "t.obj:4: face has 1 corner; at least 3 are needed"},
        {XYZ "f", "t.obj:4: face has 0 corners; at least 3 are needed"},
        {XYZ "f 1 2 9\nf 1 2 8\n", "t.obj:4: face refers to vertex 9, but the file has 3"},
        {XYZ "f 1 2 8\n\nf 1 2 9\n", "t.obj:6: face refers to vertex 9, but the file has 3"},
        {XYZ "f 1 2 0\n", "t.obj:4: face refers to vertex 0, but they count from 1"},
        {XYZ "f 1 2 -0\n", "t.obj:4: face refers to vertex 0, but they count from 1"},
        {XYZ "f 1 2 -4\nv 0 0 0\n", "t.obj:4: face refers to vertex -4, but 3 come before it"},
        {XYZ "f 1 2 4294967297\n", "t.obj:4: face refers to a vertex beyond 32 bits"},
        {XYZ "f 1 2 -4294967297\n", "t.obj:4: face refers to a vertex beyond 32 bits"},
        {XYZ "f 1 2 99999999999999999999999999\n",
         "t.obj:4: face refers to a vertex beyond 32 bits"},
        {XYZ "f 1 2 4294967295\n", "t.obj:4: face refers to vertex 4294967295, but the file has 3"},
        {XYZ "vt 0\nf 1/1 2/1 3/2\n",
         "t.obj:5: face refers to texture coordinate 2, but the file has 1"},
        {XYZ "f 1/1 2/1 3/0\n",
         "t.obj:4: face refers to texture coordinate 0, but they count from 1"},
        {XYZ "f 1//-1 2//1 3//1\nvn 0 0 1\n",
         "t.obj:4: face refers to normal -1, but 0 come before it"},
        {XYZ "f 1//1 2//2 \\\n3//1\nvn 0 0 1\n",
         "t.obj:4: face refers to normal 2, but the file has 1"},
        {XYZ "f 1 2 x\n", "t.obj:4: 'x' is not a corner; v, v/vt, v//vn or v/vt/vn is expected"},
        {XYZ "f 1 2 3.\n", "t.obj:4: '3.' is not a corner; v, v/vt, v//vn or v/vt/vn is expected"},
        {XYZ "f 1 2 +3\n", "t.obj:4: '+3' is not a corner; v, v/vt, v//vn or v/vt/vn is expected"},
        {XYZ "f 1 2 3/\n", "t.obj:4: '3/' is not a corner; v, v/vt, v//vn or v/vt/vn is expected"},
        {XYZ "f 1 2 3//\n", "t.obj:4: '3//' is not a corner; v, v/vt, v//vn or v/vt/vn is "
                            "expected"},
        {XYZ "f 1 2 3//1/1\nvn 0 0 1", "t.obj:4: '3//1/1' is not a corner; v, v/vt, v//vn or "
                                       "v/vt/vn is expected"},
        {XYZ "f 1 2 /1\n", "t.obj:4: '/1' is not a corner; v, v/vt, v//vn or v/vt/vn is expected"},
        {"v 0 0 0\r\nv 0 0 \x01\n", "t.obj:2: byte 0x01 does not belong in a text file"},
        {"#\rv 0 0 0\r\n# \x7f\n", "t.obj:3: byte 0x7f does not belong in a text file"},
        {"\x89PNG\r\n\x1a\n", "t.obj:2: byte 0x1a does not belong in a text file"},
    };
    check_bad(limni_read_obj, cases, COUNT(cases));
}

#define FACE XYZ "f 1 2 3\n"

static void test_good_tags(void) {
    static const text_case cases[] = {
        {FACE, "0 0"},
        {FACE "t crease 2/1/0 0 1 2.5\n", "5:0-1=2.5 0 0"},
        {"t crease 2/1/0 0 1 4\n" FACE, "1:0-1=4 0 0"},
        {FACE "t crease 4/1/0 0 1 2 1 3 \n", "5:0-1=3 5:2-1=3 0 0"},
        {FACE "t crease 4/2/0 0 1 2 1 3 .5\n", "5:0-1=3 5:2-1=0.5 0 0"},
        {FACE "t crease 4/2/0 0 1 \\\n2 1 3 \\\n.5\n#\nt hole 1/0/0 0",
         "5:0-1=3 5:2-1=0.5 9:0 0 0"},
        {FACE "t crease 2/1/0 0 1 -0\nt crease 2/1/0 1 0 inf\n", "5:0-1=0 6:1-0=inf 0 0"},
        {FACE "t corner 1/1/0 7 Infinity\nt corner 2/2/0 0 1 1 0\nt corner 2/1/0 1 2 9\n",
         "5:7=inf 6:0=1 6:1=0 7:1=9 7:2=9 0 0"},
        {FACE "t hole 2/0/0 0 4294967295\n", "5:0 5:4294967295 0 0"},
        {FACE "t interpolateboundary 1/0/0 0", "3 0"},
        {FACE "t interpolateboundary 1/0/0 1", "2 0"},
        {FACE "t interpolateboundary 1/0/0 1\nt interpolateboundary 1/0/0 2", "1 0"},
        {FACE "t creasemethod 0/0/1 normal", "0 1"},
        {FACE "t creasemethod 0/0/1 chaikin # smooth", "0 2"},
        {FACE "t smoothtriangles 0/0/1 smooth\nt facevaryinginterpolateboundary 1/0/0 1\n"
              "t facevaryingpropagatecorners 1/0/0 1\nt spam 1\n",
         "0 0"},
    };
    check_described(limni_read_obj, cases, COUNT(cases), describe_tags);
}

static void test_bad_tags(void) {
#define PAIRS "pairs of vertices and one sharpness, or one for each, are expected"
    static const text_case cases[] = {
        {FACE "t\n", "t.obj:5: tag without a name"},
        {FACE "t crease\n", "t.obj:5: '' does not count the values of a tag; "
                            "INTS/FLOATS/STRINGS is expected"},
        {FACE "t hole 1/0\n", "t.obj:5: '1/0' does not count the values of a tag; "
                              "INTS/FLOATS/STRINGS is expected"},
        {FACE "t hole 1/0/0/0\n", "t.obj:5: '1/0/0/0' does not count the values of a tag; "
                                  "INTS/FLOATS/STRINGS is expected"},
        {FACE "t hole -1/0/0\n", "t.obj:5: '-1/0/0' does not count the values of a tag; "
                                 "INTS/FLOATS/STRINGS is expected"},
        {FACE "t hole 4294967296/0/0 0\n",
         "t.obj:5: '4294967296/0/0' does not count the values of a tag; INTS/FLOATS/STRINGS is "
         "expected"},
        {FACE "t crease 0/1/0 1\n", "t.obj:5: tag 'crease' has 0/1/0 values; " PAIRS},
        {FACE "t crease 3/1/0 0 1 2 1\n", "t.obj:5: tag 'crease' has 3/1/0 values; " PAIRS},
        {FACE "t crease 2/2/0 0 1 1 1\n", "t.obj:5: tag 'crease' has 2/2/0 values; " PAIRS},
        {FACE "t crease 2/0/0 0 1\n", "t.obj:5: tag 'crease' has 2/0/0 values; " PAIRS},
        {FACE "t crease 2/1/1 0 1 1 a\n", "t.obj:5: tag 'crease' has 2/1/1 values; " PAIRS},
        {FACE "t crease 2/1/0 0 1\n",
         "t.obj:5: tag 'crease' has 2/1/0 values; the line ends before them"},
        {FACE "t hole 4294967295/0/0 0\n",
         "t.obj:5: tag 'hole' has 4294967295/0/0 values; the line ends before them"},
        {FACE "t crease 2/1/0 0 1 1 1\n", "t.obj:5: '1' after the values of tag 'crease'"},
        {FACE "t crease 2/1/0 0 -1 1\n", "t.obj:5: '-1' is not a valid vertex of a crease"},
        {FACE "t crease 2/1/0 0 1.5 1\n", "t.obj:5: '1.5' is not a valid vertex of a crease"},
        {FACE "t crease 2/1/0 0 4294967296 1\n",
         "t.obj:5: vertex of a crease 4294967296 is too large"},
        {FACE "t crease 2/1/0 0 1 -0.5\n", "t.obj:5: sharpness is negative: '-0.5'"},
        {FACE "t crease 2/1/0 0 1 -inf\n", "t.obj:5: sharpness is not finite: '-inf'"},
        {FACE "t crease 2/1/0 0 1 nan\n", "t.obj:5: sharpness is not finite: 'nan'"},
        {FACE "t crease 2/1/0 0 1 1e39\n", "t.obj:5: sharpness is not finite: '1e39'"},
        {FACE "t crease 2/1/0 0 1 infinit\n", "t.obj:5: sharpness is not finite: 'infinit'"},
        {FACE "t crease 2/1/0 0 1 x\n", "t.obj:5: 'x' is not a number"},
        {FACE "t corner 0/1/0 1\n", "t.obj:5: tag 'corner' has 0/1/0 values; vertices and one "
                                    "sharpness, or one for each, are expected"},
        {FACE "t corner 3/2/0 0 1 2 1 1\n", "t.obj:5: tag 'corner' has 3/2/0 values; vertices and "
                                            "one sharpness, or one for each, are expected"},
        {FACE "t corner 1/1/0 x 1\n", "t.obj:5: 'x' is not a valid corner"},
        {FACE "t hole 0/0/0\n", "t.obj:5: tag 'hole' has 0/0/0 values; faces are expected"},
        {FACE "t hole 1/1/0 0 1\n", "t.obj:5: tag 'hole' has 1/1/0 values; faces are expected"},
        {FACE "t interpolateboundary 2/0/0 1 1\n",
         "t.obj:5: tag 'interpolateboundary' has 2/0/0 values; one whole number is expected"},
        {FACE "t interpolateboundary 1/0/0 3\n",
         "t.obj:5: boundary interpolation 3 is unknown; 0, 1 or 2 is expected"},
        {FACE "t creasemethod 0/0/0\n",
         "t.obj:5: tag 'creasemethod' has 0/0/0 values; one word is expected"},
        {FACE "t creasemethod 0/0/1 Normal\n",
         "t.obj:5: crease method 'Normal' is unknown; normal or chaikin is expected"},
    };
#undef PAIRS
    check_bad(limni_read_obj, cases, COUNT(cases));
}

#define OFF_XYZ "0 0 0\n1 0 0\n0 1 0\n"
#define OFF_READ "3:0,0,0 4:1,0,0 5:0,1,0 "

static void test_good_off(void) {
    static const text_case cases[] = {
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 2\n", OFF_READ " 6:0,1,2"},
        {"OFF\n3 1\n" OFF_XYZ "3 0 1 2", OFF_READ " 6:0,1,2"},
        {"\xef\xbb\xbfOFF\n3 1 0\n" OFF_XYZ "3 0 1 2", OFF_READ " 6:0,1,2"},
        {"OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "2:0,0,0 3:1,0,0 4:0,1,0  5:0,1,2"},
        {"OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n", OFF_READ " 6:0,1,2"},
        {"# who\nOFF # what\n\n# counts\n 3\t1 0 # edges\n\n0 0 0 # a\n1 0 0\n#\n0 1 0\n3 0 1 2 #"
         "\n# end\n",
         "7:0,0,0 8:1,0,0 10:0,1,0  11:0,1,2"},
        {"OFF\n3 3 0\n" OFF_XYZ "3 0 1 2 255 0 0\n4 0 1 2 1 .5 .5 .5 1\n3 2 1 0 7\n",
         OFF_READ " 6:0,1,2 7:0,1,2,1 8:2,1,0"},
        {"COFF\n3 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9 9\n0 1 0 .1 .1 .1 1\n3 0 1 2\n",
         OFF_READ " 6:0,1,2"},
        {"NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", OFF_READ " 6:0,1,2"},
        {"STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n", OFF_READ " 6:0,1,2"},
    };
    check_good(limni_read_off, cases, COUNT(cases));
}

static void test_bad_off(void) {
    static const text_case cases[] = {
        {"", "t.off: the file is empty"},
        {"#\n", "t.off: the file is empty"},
        {"3 1 0\n" OFF_XYZ "3 0 1 2\n",
         "t.off:1: '3' is not a known header; OFF, COFF, NOFF or STOFF is expected"},
        {"4OFF\n", "t.off:1: '4OFF' is not a known header; OFF, COFF, NOFF or STOFF is expected"},
        {"off\n", "t.off:1: 'off' is not a known header; OFF, COFF, NOFF or STOFF is expected"},
        {"OFF\n", "t.off:2: the file ends before the counts of vertices and faces"},
        {"OFF BINARY\n", "t.off:1: 'BINARY' is not a valid vertex count"},
        {"OFF\n3\n", "t.off:2: the face count is missing"},
        {"OFF\n3 -1 0\n", "t.off:2: '-1' is not a valid face count"},
        {"OFF\n3 1.5 0\n", "t.off:2: '1.5' is not a valid face count"},
        {"OFF\n3 1 x\n", "t.off:2: 'x' is not a valid edge count"},
        {"OFF\n3 1 0 0\n", "t.off:2: '0' after the counts"},
        {"OFF\n4294967296 1 0\n", "t.off:2: vertex count 4294967296 is too large"},
        {"OFF\n0 0 0\n", "t.off: the file has no vertices"},
        {"OFF\n3 0 0\n" OFF_XYZ, "t.off: the file has no faces"},
        {"OFF\n4294967295 4294967295 0\n" OFF_XYZ "3 0 1 2\n",
         "t.off:2: the file ends too early for 4294967295 vertices and 4294967295 faces"},
        {"OFF\n3 1 0\n" OFF_XYZ, "t.off:2: the file ends too early for 3 vertices and 1 faces"},
        {"OFF\n3 1 0\n0.00 0.00 0.00\n1.00 0.00 0.00\n",
         "t.off:5: the file ends after 2 of 3 vertices"},
        {"OFF\n3 1 0\n0.00 0.00 0.00\n" OFF_XYZ,
         "t.off:6: face has 0 corners; at least 3 are needed"},
        {"OFF\n3 2 0\n0.000 0.000 0.000\n1 0 0\n0 1 0\n3 0 1 2\n",
         "t.off:7: the file ends after 1 of 2 faces"},
        {"OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2 255\n",
         "t.off:3: vertex has 2 numbers; 3 are expected"},
        {"OFF\n3 1 0\n0 0 0 1\n1 0 0\n0 1 0\n3 0 1 2\n",
         "t.off:3: vertex has 4 numbers; 3 are expected"},
        {"COFF\n3 1 0\n" OFF_XYZ "3 0 1 2\n", "t.off:3: vertex has 3 numbers; 6 to 7 are expected"},
        {"OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n",
         "t.off:3: coordinate is not finite: 'nan'"},
        {"OFF\n3 1 0\n" OFF_XYZ "2 0 1 255 0\n",
         "t.off:6: face has 2 corners; at least 3 are needed"},
        {"OFF\n3 1 0\n" OFF_XYZ "1 0 1 255 0\n",
         "t.off:6: face has 1 corner; at least 3 are needed"},
        {"OFF\n3 1 0\n" OFF_XYZ "4 0 1 2\n", "t.off:6: face states 4 corners, but 3 follow"},
        {"OFF\n3 1 0\n" OFF_XYZ "4000000000 0 1 2\n",
         "t.off:6: face states 4000000000 corners, but 3 follow"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 3\n",
         "t.off:6: face refers to vertex 3, but the last one is 2"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 -1\n", "t.off:6: '-1' is not a valid vertex index"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 4294967298\n",
         "t.off:6: vertex index 4294967298 is too large"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 2 red\n", "t.off:6: 'red' is not a number"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 2 1 1 1 1 1\n",
         "t.off:6: face colour has 5 numbers; 0 to 4 are expected"},
        {"OFF\n3 1 0\n" OFF_XYZ "3 0 1 2\n3 0 1 2\n", "t.off:7: '3' after the last face"},
    };
    check_bad(limni_read_off, cases, COUNT(cases));
}

static void test_zero_bytes(void) {
    static const char obj[] = "v 0 0 0\nv 1 0 0\0\nv 0 1 0\nf 1 2 3\n";
    static const char off[] = "OFF\n3 1 0\n" OFF_XYZ "3 0 1 2\n\0";
    limni_context context = {0};
    limni_source source;
    CHECK_EQUAL(read_text(&context, limni_read_obj, obj, sizeof obj - 1, &source),
                LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(context.error, "t.obj:2: byte 0x00 does not belong in a text file");
    CHECK_EQUAL(read_text(&context, limni_read_off, off, sizeof off - 1, &source),
                LIMN_BAKE_BAD_INPUT);
    CHECK_TEXT(context.error, "t.off:7: byte 0x00 does not belong in a text file");
    limni_release_all(&context);
}

static float read_one_number(const char *number) {
    char text[512];
    snprintf(text, sizeof text, "v %s 0 0\nf 1 1 1\n", number);
    limni_context context = {0};
    limni_source source;
    const limn_bake_status status =
        read_text(&context, limni_read_obj, text, strlen(text), &source);
    const float value =
        CHECK_EQUAL(status, LIMN_BAKE_OK) ? source.positions[0][0] : (float)HUGE_VAL;
    limni_release_all(&context);
    return value;
}

/// Decimal fractions are rounded once, to the nearest float, ties to even.
static void test_rounding(void) {
    static const struct {
        const char *text;
        float value;
    } cases[] = {
        {"0.1", 0x1.99999ap-4f},
        {"16777217", 0x1p24f},
        {"16777217.0000000000000000000000000000000000000000000001", 0x1.000002p24f},
        {"16777219", 0x1.000004p24f},
        {"1.00000017881393432617187499", 0x1.000002p0f}, /* rounding to double first: a tie, up */
        {"1.00000017881393432617187500", 0x1.000004p0f},
        {"3.4028235677973366e38", 0x1.fffffep127f}, /* likewise, up to infinity */
        {"1.1754943508222875e-38", 0x1p-126f},
        {"1.4e-45", 0x1p-149f},
        {"7.1e-46", 0x1p-149f},
        {"7.0e-46", 0.0f},
        {"1e-999999999999999999999", 0.0f},
        {"000000000000000000000000000000000000000000000000000000000000001.5", 1.5f},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        if (!CHECK(read_one_number(cases[i].text) == cases[i].value)) {
            fprintf(stderr, "    %s\n", cases[i].text);
        }
    }
    CHECK(signbit(read_one_number("-0.0")));
}

/// A decimal comma in the user's locale changes nothing, and the locale is still there afterwards.
static void test_locale(void) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    for (size_t i = 0; i < COUNT(names); i++) {
        if (!setlocale(LC_ALL, names[i])) continue;
        CHECK(read_one_number("1.5") == 1.5f);
        CHECK_TEXT(localeconv()->decimal_point, ",");
        setlocale(LC_ALL, "C");
        return;
    }
    printf("no locale with a decimal comma here: not tested\n");
}

typedef struct note_list {
    uint32_t count;
    char first[200];
    char last[200];
} note_list;

static void take_note(void *user, const char *text) {
    note_list *notes = user;
    snprintf(notes->count == 0 ? notes->first : notes->last, sizeof notes->first, "%s", text);
    notes->count++;
}

static void test_notes(void) {
    static const char text[] = "spam 1\nv 0 0 0\nspam \\\nf 1\nv. 1\nc\nd\ne\nff\nspamm\nh\nii\n"
                               "j\nf 1 1 1\n";
    note_list notes = {0};
    limni_context context = {.desc = {.note = take_note, .user = &notes}};
    limni_source source;
    CHECK_EQUAL(read_text(&context, limni_read_obj, text, sizeof text - 1, &source), LIMN_BAKE_OK);
    CHECK_EQUAL(notes.count, 8);
    CHECK_TEXT(notes.first, "t.obj:1: unknown keyword 'spam' is ignored");
    CHECK_TEXT(notes.last, "t.obj:11: unknown keyword 'h' is ignored");
    limni_release_all(&context);

    static const char tags[] = FACE "t vertexedit 1\nt spam\nt vertexedit 2/\n"
                                    "t smoothtriangles 0/0/1 smooth\n";
    notes = (note_list){0};
    CHECK_EQUAL(read_text(&context, limni_read_obj, tags, sizeof tags - 1, &source), LIMN_BAKE_OK);
    CHECK_EQUAL(notes.count, 2);
    CHECK_TEXT(notes.first, "t.obj:5: unknown tag 'vertexedit' is ignored");
    CHECK_TEXT(notes.last, "t.obj:6: unknown tag 'spam' is ignored");
    limni_release_all(&context);
}

static const char obj_sample[] =
    "\xef\xbb\xbf# cage\r\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 .5 .5 .5\nv 1.5e0 -1 +.25\\\n\nvt 0 1\n"
    "vn 0 0 1\nspam\nt crease 4/2/0 0 1 2 3 1 inf\nt corner 1/1/0 0 9.5\nt hole 1/0/0 1\n"
    "t creasemethod 0/0/1 chaikin\nt interpolateboundary 1/0/0 2\nf 1/1/1 2/1/1 3/-1/-1\nf 4//1 "
    "\\\n 3 -2\nv 0 1 0\n";
static const char off_sample[] =
    "COFF # cage\r\n4 2 0\n0 0 0 1 1 1\n1 0 0 1 1 1 1\n\n1.5e0 -1 +.25 "
    "0 0 0\n0 1 0 1 1 1\n3 0 1 2 255 0 0\n4 0 1 2 3\n# end\n";

static void test_prefixes(void) {
    for (size_t size = 0; size < sizeof obj_sample; size++) {
        read_anything(limni_read_obj, obj_sample, size);
    }
    for (size_t size = 0; size < sizeof off_sample; size++) {
        read_anything(limni_read_off, off_sample, size);
    }
    CHECK(read_anything(limni_read_obj, obj_sample, sizeof obj_sample - 1));
    CHECK(read_anything(limni_read_off, off_sample, sizeof off_sample - 1));
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    if (!CHECK(file != NULL)) return;
    fputs(text, file);
    fclose(file);
}

static void check_file_error(const char *path, limn_bake_status expected, const char *error) {
    limni_context context = {0};
    limni_source source;
    CHECK_EQUAL(limni_read_file(&context, path, &source), expected);
    CHECK_TEXT(context.error, error);
    limni_release_all(&context);
}

static void test_file_errors(void) {
    check_file_error("missing.obj", LIMN_BAKE_IO,
                     "missing.obj: cannot be read: No such file or directory");
    mkdir("test_readers.obj", 0700);
    check_file_error("test_readers.obj", LIMN_BAKE_IO, "test_readers.obj: is a folder, not a file");
    write_text("test_readers.obj/a.b.stl", "solid\n");
    check_file_error("test_readers.obj/a.b.stl", LIMN_BAKE_BAD_INPUT,
                     "test_readers.obj/a.b.stl: unknown kind of file; .obj, .off, .ply, .gltf, "
                     ".glb, .fbx and .dae are read");
    remove("test_readers.obj/a.b.stl");
    write_text("test_readers.obj/obj", "");
    check_file_error("test_readers.obj/obj", LIMN_BAKE_BAD_INPUT,
                     "test_readers.obj/obj: unknown kind of file; .obj, .off, .ply, .gltf, .glb, "
                     ".fbx and .dae are read");
    remove("test_readers.obj/obj");
    write_text("test_readers.obj/empty.off", "");
    check_file_error("test_readers.obj/empty.off", LIMN_BAKE_BAD_INPUT,
                     "test_readers.obj/empty.off: the file is empty");
    /* A file with a hole, which takes no room on the disk. */
    if (sizeof(off_t) > 4 && truncate("test_readers.obj/empty.off", (off_t)UINT32_MAX) == 0) {
        check_file_error("test_readers.obj/empty.off", LIMN_BAKE_BAD_INPUT,
                         "test_readers.obj/empty.off: the file has 4 GiB or more");
    }
    remove("test_readers.obj/empty.off");
    rmdir("test_readers.obj");
}

static void test_file_names(void) {
    char path[] = "./test_readers.v2.ObJ";
    write_text(path, XYZ "f 1 2 3\n");
    limni_context context = {0};
    limni_source source;
    if (CHECK_EQUAL(limni_read_file(&context, path, &source), LIMN_BAKE_OK)) {
        remove(path);
        memset(path, 'x', sizeof path - 1); /* the source keeps its own copy */
        CHECK_TEXT(source.path, "./test_readers.v2.ObJ");
        CHECK_TEXT(source.name, "test_readers.v2");
        CHECK_TEXT(describe(&source), XYZ_READ " 4:0,1,2");
    }
    limni_release_all(&context);
}

/// Counts from the manifest of the assets, and from their own text.
static void test_assets(void) {
    static const struct {
        const char *path;
        uint32_t vertices, faces;
    } files[] = {
        {"meshes/bigguyT.obj", 1452, 2900},
        {"meshes/monsterfrogT.obj", 1308, 2584},
        {"meshes/carT.obj", 1642, 3150},
        {"meshes/rookT.obj", 768, 1510},
        {"meshes/human_man.obj", 6890, 13776},
        {"meshes/hand_lowres.obj", 810, 1602},
        {"meshes/spot_low_resolution.obj", 829, 1654},
        {"meshes/spot_control_mesh.obj", 188, 180},
        {"meshes/fish_control_mesh.obj", 112, 112},
        {"meshes/penguin_control_mesh.obj", 201, 221},
        {"meshes/cheburashka.obj", 6669, 13334},
        {"meshes/mannequin-devil.off", 12977, 25888},
        {"meshes/nefertiti.off", 299, 562},
        {"meshes/dragknob.off", 161, 318},
        {"meshes/suzanne.obj", 507, 500},
        {"meshes/cow.obj", 2903, 5804},
        {"meshes/teapot.obj", 3644, 6320},
        {"meshes/beetle.obj", 1148, 2053},
        {"quads/Bigguy.obj", 1452, 1450},
        {"quads/Monsterfrog.obj", 1308, 1292},
        {"quads/Bishop.obj", 917, 968},
        {"opensubdiv_shapes/catmark_cube.obj", 8, 6},
        {"opensubdiv_shapes/loop_cube.obj", 14, 24},
        {"opensubdiv_shapes/loop_icosahedron.obj", 12, 20},
        {"opensubdiv_shapes/catmark_pole360.obj", 721, 720},
    };
    const char *folder = getenv("LIMN_TEST_ASSETS");
    if (!folder || !*folder) {
        printf("LIMN_TEST_ASSETS is not set: no files read\n");
        return;
    }
    for (size_t i = 0; i < COUNT(files); i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, files[i].path);
        limni_context context = {0};
        limni_source source;
        if (CHECK_EQUAL(limni_read_file(&context, path, &source), LIMN_BAKE_OK)) {
            CHECK_EQUAL(source.position_count, files[i].vertices);
            CHECK_EQUAL(source.face_count, files[i].faces);
            CHECK(is_valid(&source));
        } else {
            fprintf(stderr, "    %s\n", context.error);
        }
        limni_release_all(&context);
    }
}

int main(void) {
    test_good_obj();
    test_channels();
    test_bad_obj();
    test_good_tags();
    test_bad_tags();
    test_good_off();
    test_bad_off();
    test_zero_bytes();
    test_rounding();
    test_locale();
    test_notes();
    test_prefixes();
    test_mutations(limni_read_obj, obj_sample, sizeof obj_sample - 1);
    test_mutations(limni_read_off, off_sample, sizeof off_sample - 1);
    test_file_errors();
    test_file_names();
    test_assets();
    return check_report();
}
