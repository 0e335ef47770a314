/* SPDX-License-Identifier: MIT */
/* A scene as OpenSubdiv gets it. */
#ifndef OPENSUBDIV_SCENE_H
#define OPENSUBDIV_SCENE_H

#include "scene.h"

#include "opensubdiv.h"

inline limni_opensubdiv_mesh describe_scene(const peer_scene &scene) {
    limni_opensubdiv_mesh mesh = {};
    mesh.positions = scene.controls[0];
    mesh.faces = scene.face_corners;
    mesh.face_sizes = scene.face_sizes;
    mesh.position_count = scene.control_count;
    mesh.face_count = scene.face_count;
    mesh.scheme =
        scene.scheme == LIMN_SCHEME_LOOP ? LIMNI_OPENSUBDIV_LOOP : LIMNI_OPENSUBDIV_CATMARK;
    mesh.divided = scene.divided;
    mesh.level = scene.level;
    return mesh;
}

#endif
