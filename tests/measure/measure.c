// Runs a program: `measure SECONDS PROGRAM WORDS...`. Its last line on standard error is then the seconds
// that it took of the processor and the kilobytes that it held at most, and its exit code the program's; 99
// where a signal ended it, as SIGALRM does after so many seconds.
#define _DEFAULT_SOURCE // wait4
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char** argv)
{
    if (argc < 3) {
        fprintf(stderr, "measure: give seconds and a program\n");
        return 2;
    }
    const pid_t child = fork();
    if (child == 0) {
        alarm((unsigned)atoi(argv[1])); // which exec keeps
        execv(argv[2], argv + 2);
        perror(argv[2]);
        _exit(127);
    }
    int status;
    struct rusage usage;
    if (child < 0 || wait4(child, &status, 0, &usage) != child) {
        perror("measure");
        return 2;
    }
    const double seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                           (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1e6;
    fprintf(stderr, "%.3f %ld\n", seconds, usage.ru_maxrss);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}
