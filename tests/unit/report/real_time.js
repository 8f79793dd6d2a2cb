// A self-test for which time passes as it does for a reader, with frames: the page counts as loaded, and the browser
// writes it out, when the self-test has come to its end.

/** What `act` returns, with errors of the page among its complaints. An iframe that is written to holds up the page's load event until then. */
async function inRealTime(act) {
  const errors = [];
  addEventListener('error', ({message, error}) => errors.push(`an error in the page: ${message} ${error?.stack ?? ''}`));
  addEventListener('unhandledrejection', ({reason}) => errors.push(`a rejection in the page: ${reason?.stack ?? reason}`));
  for (const name of ['error', 'warn']) {
    const own = console[name];
    console[name] = (...words) => (errors.push(`console.${name}: ${words.join(' ')}`), own.apply(console, words));
  }
  const held = document.createElement('iframe');
  held.hidden = true;
  document.body.append(held);
  held.contentDocument.open();
  const late = new Promise((_, fail) => setTimeout(() => fail(new Error('the self-test takes more than five minutes')), 300000));
  try {
    const seen = await Promise.race([act(), late]);
    return {...seen, lines: [...seen.lines ?? [], ...errors]};
  } finally {
    setTimeout(() => held.contentDocument.close(), 100);
  }
}
