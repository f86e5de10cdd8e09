// For measurements: stands after path.glsl and counts the texture reads of all that follows.
int g_reads = 0;
#define texelFetch(s, p, l) (++g_reads, texelFetch(s, p, l))

void writeCountedPathEnd(Path p, int status, uint triangle, int end)
{
    writePathEnd(p, status, triangle, end);
    o_path.w |= uint(min(g_reads, VT_MAX_READS)) << VT_PATH_READS_SHIFT;
}

void writeCountedPath(Path p, int status)
{
    writeCountedPathEnd(p, status, VT_NO_TRIANGLE, -1);
}
#define writePath writeCountedPath
#define writePathEnd writeCountedPathEnd
