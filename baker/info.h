/* SPDX-License-Identifier: MIT */
/* How a file was baked: limn_pack.info, words `key=value` separated by blanks. */
#ifndef LIMNI_INFO_H
#define LIMNI_INFO_H

#include <stddef.h>

/// The value of `key`, copied to `value`; "" if there is none.
void limni_info_value(const char *info, const char *key, char *value, size_t value_size);

#endif
