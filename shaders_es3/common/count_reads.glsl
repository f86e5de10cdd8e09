// For measurements: stands before all others and counts their texture reads.
#define COUNT_READS
int g_reads = 0;
#define texelFetch(s, p, l) (++g_reads, texelFetch(s, p, l))
#define textureLod(s, p, l) (++g_reads, textureLod(s, p, l))
