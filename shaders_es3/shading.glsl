vec3 shadeSurface(int object, uint triangle, vec3 w, vec3 I, float footprint)
{
    return objectNumbers(object, VT_OBJECT_COLOR).rgb;
}
