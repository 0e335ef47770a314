/* SPDX-License-Identifier: MIT */
#include "info.h"

#include <stdio.h>
#include <string.h>

void limni_info_value(const char *info, const char *key, char *value, size_t value_size) {
    const size_t key_length = strlen(key);
    value[0] = '\0';
    for (const char *word = info; *word; word += strspn(word, " ")) {
        const size_t length = strcspn(word, " ");
        if (length > key_length && word[key_length] == '=' && memcmp(word, key, key_length) == 0)
            snprintf(value, value_size, "%.*s", (int)(length - key_length - 1),
                     word + key_length + 1);
        word += length;
    }
}
