// For measurements: stands after path.glsl and counts the texture reads of all that follows.
int g_reads = 0;
#define texelFetch(s, p, l) (++g_reads, texelFetch(s, p, l))

void writeCountedPath(Path p, int status)
{
    writePath(p, status);
    o_path.w |= uint(min(g_reads, VT_MAX_READS)) << VT_PATH_READS_SHIFT;
}
#define writePath writeCountedPath
