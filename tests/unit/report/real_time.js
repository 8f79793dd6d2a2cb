// A self-test for which time passes as it does for a reader, with frames: the page counts as loaded, and the browser
// writes it out, when the self-test has come to its end.

/** What `act` returns. An iframe that is written to holds up the page's load event until then. */
async function inRealTime(act) {
  const held = document.createElement('iframe');
  held.hidden = true;
  document.body.append(held);
  held.contentDocument.open();
  const late = new Promise((_, fail) => setTimeout(() => fail(new Error('the self-test takes more than five minutes')), 300000));
  try {
    return await Promise.race([act(), late]);
  } finally {
    setTimeout(() => held.contentDocument.close(), 100);
  }
}
