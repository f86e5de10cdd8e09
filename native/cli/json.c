#include "cli/json.h"

#include <math.h>

static void writeText(FILE* out, const char* text)
{
    fputc('"', out);
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            fprintf(out, "\\%c", c);
        } else if (c < 32) {
            fprintf(out, "\\u%04x", (unsigned)c);
        } else {
            fputc(c, out);
        }
    }
    fputc('"', out);
}

/// What comes before a value.
static void begin(vtJson* json, const char* name)
{
    fputs(json->follows ? "," : "", json->out);
    if (name != NULL) {
        writeText(json->out, name);
        fputc(':', json->out);
    }
    json->follows = true;
}

static void open(vtJson* json, const char* name, char bracket)
{
    begin(json, name);
    fputc(bracket, json->out);
    json->follows = false;
}

static void close(vtJson* json, char bracket)
{
    fputc(bracket, json->out);
    json->follows = true;
}

void vtJson_BeginObject(vtJson* json, const char* name)
{
    open(json, name, '{');
}

void vtJson_EndObject(vtJson* json)
{
    close(json, '}');
}

void vtJson_BeginArray(vtJson* json, const char* name)
{
    open(json, name, '[');
}

void vtJson_EndArray(vtJson* json)
{
    close(json, ']');
}

void vtJson_Text(vtJson* json, const char* name, const char* text)
{
    begin(json, name);
    writeText(json->out, text);
}

void vtJson_Integer(vtJson* json, const char* name, long long value)
{
    begin(json, name);
    fprintf(json->out, "%lld", value);
}

void vtJson_Number(vtJson* json, const char* name, double value, int decimals)
{
    begin(json, name);
    if (isfinite(value)) {
        fprintf(json->out, "%.*f", decimals, value);
    } else {
        fputs("null", json->out);
    }
}
