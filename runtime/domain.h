/* SPDX-License-Identifier: MIT */
#ifndef LIMNI_DOMAIN_H
#define LIMNI_DOMAIN_H

#include "limn/limn.h"

extern const limn_domain limni_domain_triangle;

#endif
