"""Expressions that examine the drawing of a page: visible parts of the scene, items too wide or too faint."""

# Shares of the scene's canvas that are not background: in its middle half, and along its two sides.
DRAWN = """(() => {
    const from = element("canvas"), copy = document.createElement("canvas");
    const [width, height] = [copy.width, copy.height] = [from.width, from.height];
    const context = copy.getContext("2d");
    context.drawImage(from, 0, 0);
    const [r, g, b] = new THREE.Color(theme().background).toArray().map((c) => Math.round(255 * c));
    const drawn = (x, y, w, h) => {
      const {data} = context.getImageData(x, y, w, h);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i] !== r || data[i + 1] !== g || data[i + 2] !== b) ++count;
      return count / (w * h);
    };
    return [drawn(width >> 2, height >> 2, width >> 1, height >> 1), drawn(0, 0, 2, height) + drawn(width - 2, 0, 2, height)];
  })()"""

# Elements that go beyond the window, or whose text goes beyond them.
TOO_WIDE = """[...document.querySelectorAll("body *")].filter((item) => {
    const box = item.getBoundingClientRect();
    return box.width > 0 && (box.right > innerWidth + 1 || box.left < -1
      || (item.matches("button, legend, label, td, h1") && item.scrollWidth > item.clientWidth + 1));
  }).map((item) => item.tagName + "#" + item.id + " " + item.textContent.slice(0, 20))"""

# Texts whose contrast with their background (WCAG 2) is less than 4.5, and the colours that texts on the picture have.
TOO_FAINT = """(() => {
    const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
    const light = (rgb) => rgb.slice(0, 3).map((c) => c / 255)
      .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
      .reduce((sum, c, k) => sum + [0.2126, 0.7152, 0.0722][k] * c, 0);
    const contrast = (a, b) => { const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
      return (high + 0.05) / (low + 0.05); };
    const behind = (item) => {
      for (; item; item = item.parentElement) {
        const colour = numbers(getComputedStyle(item).backgroundColor);
        if (colour.length < 4 || colour[3] > 0) return colour;
      }
      return [255, 255, 255];
    };
    const faint = [...document.querySelectorAll("body *")].filter((item) => item.getClientRects().length > 0
      && !item.matches("script, option, optgroup, :disabled")
      && [...item.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())
      && contrast(numbers(getComputedStyle(item).color), behind(item)) < 4.5)
      .map((item) => item.tagName + "#" + item.id + " " + item.textContent.slice(0, 20));
    const rgb = (colour) => new THREE.Color(colour).toArray().map((c) => 255 * c);
    if (contrast(rgb(theme().text), rgb(theme().background)) < 4.5) faint.push("text on the picture");
    return faint;
  })()"""
