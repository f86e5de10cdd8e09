// Acts on a window of an X display as its user does, by Xlib alone, for the tests of `vitrine view`.
//   act_on_window TITLE title              prints the title of the window whose title begins so
//   act_on_window TITLE key NAME           presses a key: space, Home, Right ...
//   act_on_window TITLE drag BUTTON X0 X1  from a column to another, a third of the height from the top
//   act_on_window TITLE drop FILE...       drags files from another program and drops them on it (XDND 5)
//   act_on_window TITLE picture OUT.ppm    what is seen of it
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct Target {
    Display* display;
    Window root, window;
    int width, height;
} Target;

static void fail(const char* what, const char* name)
{
    fprintf(stderr, "act_on_window: %s '%s'\n", what, name);
    exit(1);
}

static unsigned long milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (unsigned long)now.tv_sec * 1000 + (unsigned long)now.tv_nsec / 1000000;
}

/// Finds the window; prints its title if asked to.
static Target findWindow(const char* start, int prints)
{
    Target target = {.display = XOpenDisplay(NULL)};
    Window parent, *children;
    unsigned count;
    if (target.display == NULL) {
        fail("no display", "");
    }
    target.root = DefaultRootWindow(target.display);
    XQueryTree(target.display, target.root, &target.root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i) {
        char* title = NULL;
        if (XFetchName(target.display, children[i], &title) && strncmp(title, start, strlen(start)) == 0) {
            XWindowAttributes attributes;
            XGetWindowAttributes(target.display, children[i], &attributes);
            target.window = children[i];
            target.width = attributes.width;
            target.height = attributes.height;
            if (prints) {
                puts(title);
            }
        }
        XFree(title);
    }
    XFree(children);
    if (target.window == None) {
        fail("no window", start);
    }
    return target;
}

// ---------------------------------------------------------------------------------------- keys and buttons

static void pressKey(const Target* target, const char* name)
{
    const KeySym symbol = XStringToKeysym(name);
    if (symbol == NoSymbol) {
        fail("no key", name);
    }
    XKeyEvent event = {.display = target->display,
                       .window = target->window,
                       .root = target->root,
                       .time = milliseconds(),
                       .same_screen = True,
                       .keycode = XKeysymToKeycode(target->display, symbol)};
    event.type = KeyPress;
    XSendEvent(target->display, target->window, True, KeyPressMask, (XEvent*)&event);
    event.type = KeyRelease;
    event.time += 1;
    XSendEvent(target->display, target->window, True, KeyReleaseMask, (XEvent*)&event);
}

static void turnButton(const Target* target, int type, long mask, unsigned button)
{
    XButtonEvent event = {.type = type,
                          .display = target->display,
                          .window = target->window,
                          .root = target->root,
                          .time = milliseconds(),
                          .same_screen = True,
                          .button = button};
    XSendEvent(target->display, target->window, True, mask, (XEvent*)&event);
}

static void movePointer(const Target* target, int x)
{
    XWarpPointer(target->display, None, target->window, 0, 0, 0, 0, x, target->height / 3);
    XSync(target->display, False);
}

static void drag(const Target* target, unsigned button, int from, int to)
{
    movePointer(target, from);
    turnButton(target, ButtonPress, ButtonPressMask, button);
    movePointer(target, (from + to) / 2);
    movePointer(target, to);
    turnButton(target, ButtonRelease, ButtonReleaseMask, button);
}

// ------------------------------------------------------------------------------------------- dropped files

static void sendToTarget(const Target* target, const char* type, const long* values)
{
    XClientMessageEvent event = {.type = ClientMessage,
                                 .display = target->display,
                                 .window = target->window,
                                 .message_type = XInternAtom(target->display, type, False),
                                 .format = 32};
    memcpy(event.data.l, values, 5 * sizeof(long));
    XSendEvent(target->display, target->window, False, NoEventMask, (XEvent*)&event);
}

/// Gives the list of names to who asks for it.
static void answer(const Target* target, const XSelectionRequestEvent* asked, const char* list)
{
    XSelectionEvent event = {.type = SelectionNotify,
                             .display = target->display,
                             .requestor = asked->requestor,
                             .selection = asked->selection,
                             .target = asked->target,
                             .property = asked->property,
                             .time = asked->time};
    XChangeProperty(target->display, asked->requestor, asked->property, asked->target, 8, PropModeReplace,
                    (const unsigned char*)list, (int)strlen(list));
    XSendEvent(target->display, asked->requestor, False, NoEventMask, (XEvent*)&event);
}

static void drop(const Target* target, int count, char** files)
{
    Display* display = target->display;
    char list[8192] = "";
    for (int i = 0; i < count; ++i) {
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "file://%s\r\n", files[i]);
    }
    const long source = (long)XCreateSimpleWindow(display, target->root, 0, 0, 1, 1, 0, 0, 0);
    const long type = (long)XInternAtom(display, "text/uri-list", False);
    const long copies = (long)XInternAtom(display, "XdndActionCopy", False);
    const Atom finished = XInternAtom(display, "XdndFinished", False);
    XSetSelectionOwner(display, XInternAtom(display, "XdndSelection", False), (Window)source, CurrentTime);
    sendToTarget(target, "XdndEnter", (long[5]){source, 5L << 24, type, 0, 0});
    sendToTarget(target, "XdndPosition", (long[5]){source, 0, 10L << 16 | 10, CurrentTime, copies});
    sendToTarget(target, "XdndDrop", (long[5]){source, 0, CurrentTime, 0, 0});
    for (;;) {
        XEvent event;
        XNextEvent(display, &event);
        if (event.type == SelectionRequest) {
            answer(target, &event.xselectionrequest, list);
        } else if (event.type == ClientMessage && event.xclient.message_type == finished) {
            return;
        }
    }
}

// ------------------------------------------------------------------------------------------------ pictures

static void savePicture(const Target* target, const char* path)
{
    XImage* image = XGetImage(target->display, target->window, 0, 0, (unsigned)target->width,
                              (unsigned)target->height, AllPlanes, ZPixmap);
    FILE* file = fopen(path, "wb");
    if (image == NULL || file == NULL) {
        fail("cannot be written:", path);
    }
    fprintf(file, "P6 %d %d 255\n", image->width, image->height);
    for (int i = 0; i < image->width * image->height; ++i) {
        const unsigned long pixel = XGetPixel(image, i % image->width, i / image->width);
        fputc((int)(pixel >> 16 & 255), file);
        fputc((int)(pixel >> 8 & 255), file);
        fputc((int)(pixel & 255), file);
    }
    XDestroyImage(image);
    if (fclose(file) != 0) {
        fail("cannot be written:", path);
    }
}

int main(int count, char** words)
{
    if (count < 3) {
        fail("needs a title and what to do, not", count > 1 ? words[1] : "");
    }
    const char* action = words[2];
    const Target target = findWindow(words[1], strcmp(action, "title") == 0);
    if (strcmp(action, "key") == 0 && count == 4) {
        pressKey(&target, words[3]);
    } else if (strcmp(action, "drag") == 0 && count == 6) {
        drag(&target, (unsigned)atoi(words[3]), atoi(words[4]), atoi(words[5]));
    } else if (strcmp(action, "drop") == 0 && count > 3) {
        drop(&target, count - 3, words + 3);
    } else if (strcmp(action, "picture") == 0 && count == 4) {
        savePicture(&target, words[3]);
    } else if (strcmp(action, "title") != 0) {
        fail("does not know", action);
    }
    XCloseDisplay(target.display);
    return 0;
}
