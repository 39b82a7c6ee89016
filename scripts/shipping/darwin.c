/* What darwin.py binds a module for macOS to on Linux where the C libraries differ: mac_f stands for macOS' f. */
#define _GNU_SOURCE
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char mac__DefaultRuneLocale[4096]; /* no character is a letter */
FILE *mac___stdinp, *mac___stdoutp, *mac___stderrp;
__attribute__((constructor)) static void open_streams(void) {
    mac___stdinp = stdin;
    mac___stdoutp = stdout;
    mac___stderrp = stderr;
}

int* mac___error(void) { return &errno; }

struct sine_and_cosine {
    double sine, cosine;
};
struct sine_and_cosine mac___sincos_stret(double angle) {
    struct sine_and_cosine result;
    sincos(angle, &result.sine, &result.cosine);
    return result;
}

void mac_memset_pattern16(char* target, const char* pattern, size_t size) {
    for (size_t done = 0; done < size; done++) target[done] = pattern[done % 16];
}

int mac_snprintf_l(char* target, size_t size, void* locale, const char* format, ...) {
    (void)locale;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(target, size, format, arguments);
    va_end(arguments);
    return length;
}

int mac____mb_cur_max_l(void* locale) { return (void)locale, 1; }

int mac_mbtowc_l(wchar_t* wide, const char* text, size_t size, void* locale) {
    return (void)locale, mbtowc(wide, text, size);
}

int mac_freelocale(void* locale) { return (void)locale, 0; }

unsigned mac_pthread_mach_thread_np(pthread_t thread) { return (void)thread, (unsigned)gettid(); }

enum { mac_processors_online = 58 };
long mac_sysconf(int name) { return name == mac_processors_online ? sysconf(_SC_NPROCESSORS_ONLN) : -1; }

/* A mutex or condition variable that is initialised as it is compiled begins with a mark; Linux' are all zero.
 * macOS' are at least as large. */
static void make_ours(void* object) {
    const long marks[] = {0x32AAABA7, 0x3CB0B1BB};
    for (int kind = 0; kind < 2; kind++) {
        long mark = marks[kind];
        __atomic_compare_exchange_n((long*)object, &mark, 0, 0, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
    }
}
int mac_pthread_mutex_lock(pthread_mutex_t* mutex) { return make_ours(mutex), pthread_mutex_lock(mutex); }
int mac_pthread_mutex_unlock(pthread_mutex_t* mutex) { return make_ours(mutex), pthread_mutex_unlock(mutex); }
int mac_pthread_mutex_destroy(pthread_mutex_t* mutex) { return make_ours(mutex), pthread_mutex_destroy(mutex); }
int mac_pthread_cond_broadcast(pthread_cond_t* changed) { return make_ours(changed), pthread_cond_broadcast(changed); }
int mac_pthread_cond_destroy(pthread_cond_t* changed) { return make_ours(changed), pthread_cond_destroy(changed); }
int mac_pthread_cond_wait(pthread_cond_t* changed, pthread_mutex_t* mutex) {
    make_ours(changed);
    make_ours(mutex);
    return pthread_cond_wait(changed, mutex);
}
int mac_pthread_key_create(unsigned long* key, void (*destroy)(void*)) {
    pthread_key_t ours;
    int status = pthread_key_create(&ours, destroy);
    *key = ours;
    return status;
}

/* A thread's variables: one block for the module, all zero at first. The call that asks for one changes rax alone. */
size_t mac_thread_variables;
struct variable {
    void* find;
    unsigned long key, offset;
};
__attribute__((used)) static char* find_variable(const struct variable* variable) {
    static __thread char* block;
    if (!block) block = calloc(1, mac_thread_variables);
    return block + variable->offset;
}
__asm__(
    ".globl mac__tlv_bootstrap\n"
    "mac__tlv_bootstrap:\n"
    "push %rbp\n mov %rsp, %rbp\n and $-64, %rsp\n sub $512, %rsp\n fxsave (%rsp)\n"
    "push %rcx\n push %rdx\n push %rsi\n push %rdi\n push %r8\n push %r9\n push %r10\n push %r11\n"
    "call find_variable\n"
    "pop %r11\n pop %r10\n pop %r9\n pop %r8\n pop %rdi\n pop %rsi\n pop %rdx\n pop %rcx\n"
    "fxrstor (%rsp)\n mov %rbp, %rsp\n pop %rbp\n ret\n");
