// The one set of layers that shows all glass.
Layers layersOfAll()
{
    return Layers(u_layerFrustum, u_layerDepth.xyz, u_boundsMin.xyz, u_boundsMax.xyz, 0);
}
