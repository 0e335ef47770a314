/* SPDX-License-Identifier: MIT */
/*
 * Compares two PNG files of the same size: prints the mean difference of their values, 0 to 255.
 *
 *     compare_pictures A.png B.png TOLERANCE
 *
 * Exit status: 0 it is at most the tolerance; 1 it is above; 2 they cannot be compared.
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

static png_bytep read_picture(const char *path, png_image *image) {
    *image = (png_image){.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(image, path)) {
        fprintf(stderr, "%s: %s\n", path, image->message);
        return NULL;
    }
    image->format = PNG_FORMAT_RGB;
    png_bytep pixels = malloc(PNG_IMAGE_SIZE(*image));
    if (!pixels || !png_image_finish_read(image, NULL, pixels, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, image->message);
        free(pixels);
        return NULL;
    }
    return pixels;
}

static double mean_difference(const png_byte *a, const png_byte *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += abs(a[i] - b[i]);
    return sum / (double)count;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: compare_pictures A.png B.png TOLERANCE\n");
        return 2;
    }
    png_image images[2];
    png_bytep const a = read_picture(argv[1], &images[0]);
    png_bytep const b = read_picture(argv[2], &images[1]);
    int status = 2;
    if (a && b && images[0].width == images[1].width && images[0].height == images[1].height) {
        const double mean = mean_difference(a, b, PNG_IMAGE_SIZE(images[0]));
        status = mean > strtod(argv[3], NULL);
        printf("%.3f\n", mean);
    }
    free(a);
    free(b);
    return status;
}
