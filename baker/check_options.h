/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_CHECK_OPTIONS_H
#define LIMNI_CHECK_OPTIONS_H

#include "context.h"

/// Refuses options of context->desc that do nothing with the scheme, or contradict one another, by
/// their names on the command line.
limn_bake_status limni_check_options(limni_context *context);

#endif
