/* SPDX-License-Identifier: MIT */
#include "check_options.h"

#include "scheme.h"

/// What is wrong; NULL: nothing.
static const char *find_fault(const limn_bake_desc *desc) {
    const bool loop = desc->scheme == LIMN_SCHEME_LOOP;
    const bool creased = limni_scheme_has_creases(desc->scheme);
    if (desc->weights != LIMN_WEIGHTS_LOOP && !loop) return "--weights are those of --scheme loop";
    if (desc->tension != 0 && desc->scheme != LIMN_SCHEME_BUTTERFLY)
        return "--tension is that of --scheme butterfly";
    if (!(desc->tension >= -0.25f && desc->tension <= 0.25f))
        return "--tension is not between -0.25 and 0.25";
    if (desc->creases == LIMN_CREASES_LOMONT && !loop)
        return "--creases lomont goes with --scheme loop";
    if (desc->creasing != LIMN_CREASING_DEFAULT && !creased)
        return "--creasing goes with --scheme loop or catmark";
    if (desc->creasing == LIMN_CREASING_CHAIKIN && desc->creases == LIMN_CREASES_LOMONT)
        return "--creasing chaikin goes with --creases opensubdiv";
    if (desc->boundary == LIMN_BOUNDARY_EDGE_AND_CORNER && !creased)
        return "--boundary edge-and-corner goes with --scheme loop or catmark";
    if (desc->scheme == LIMN_SCHEME_NONE && desc->face_varying != LIMN_FACE_VARYING_DEFAULT &&
        desc->face_varying != LIMN_FACE_VARYING_ALL)
        return "with --scheme none, --face-varying is all";
    return NULL;
}

limn_bake_status limni_check_options(limni_context *context) {
    const char *const fault = find_fault(&context->desc);
    return fault ? limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s", fault) : LIMN_BAKE_OK;
}
