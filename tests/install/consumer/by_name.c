/* SPDX-License-Identifier: BSD-3-Clause */
/* Somebody else's program that opens the library by its development name, and prints which build it was given. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

typedef const char *text_function(void);

static text_function *find(void *library, const char *name) {
  text_function *function = NULL;
  void *address = dlsym(library, name);
  memcpy(&function, &address, sizeof function); /* C99 has no conversion between the two */
  return function;
}

int main(void) {
  void *library = dlopen("libcairn.so", RTLD_NOW);
  text_function *version, *build;
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  version = find(library, "cairn_version");
  build = find(library, "cairn_build");
  if (version == NULL || build == NULL) return 2;
  printf("%s %s\n", version(), build());
  return dlclose(library) == 0 ? 0 : 3;
}
